/// @file  In place of the live image of a finished bite: how the jaws meet, or what is missing.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "ui/panels/panels.h"
#include "ui/state/jaw_words.h"
#include "ui/state/jaws_look.h"
#include "ui/state/stage_group.h"
#include "ui/theme/icons.h"
#include "ui/widgets/badge.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kValueRow = 24.0F, kTopButton = 44.0F, kSliderHeight = 36.0F;
/// A far side that is less certain than this gets advice: half of what intra-oral scanners reach.
constexpr double kFarLimit_mm = 0.05;

Text progress_text(StageProgress progress) {
  if (progress == StageProgress::kFinished) return Text::kFinished;
  return progress == StageProgress::kScanned ? Text::kStageScanned : Text::kStageEmpty;
}

void draw_missing(const PanelContext& context, Rect rest) {
  for (const io::ScanStage stage : io::kScanStages) {
    const StageProgress progress = progress_of(stage, context.view);
    if (stage != base_of(stage) && progress == StageProgress::kEmpty) continue;
    labeled_value(context.theme, rest.take_top(context.px(kValueRow)),
                  context.text(stage_name(stage)), context.text(progress_text(progress)));
  }
  rest.take_top(context.px(kGapM));
  draw_wrapped(rest, {context.theme.fonts.small, kTextQuiet},
               context.text(Text::kOcclusionMissing));
}

void draw_running(const PanelContext& context, Rect rest) {
  const Theme& theme = context.theme;
  draw_fitted(rest.take_top(context.px(40.0F), context.px(kGapS)), {theme.fonts.body}, kText,
              context.text(Text::kClosingJaws));
  meter(theme, rest.take_top(context.px(16.0F)), context.view.occlusion.done_share, kCaution);
}

void draw_failure(const PanelContext& context, Rect rest) {
  const Theme& theme = context.theme;
  const float height =
      draw_wrapped(rest, {theme.fonts.strong, kBad}, context.text(Text::kNoOcclusion));
  rest.take_top(height, context.px(kGapS));
  draw_wrapped(rest, {theme.fonts.small, kText}, sentence(context.view.occlusion.failure));
}

void slider(const PanelContext& context, Rect& rest, const char* id, Text label, float& value,
            float most, const char* format) {
  draw_text(rest.take_top(context.px(20.0F), context.px(kGapXs)),
            {context.theme.fonts.small, kText, Align::kLeft}, context.text(label));
  const Rect box = rest.take_top(context.px(kSliderHeight), context.px(kGapS));
  ImGui::SetCursorScreenPos(box.min());
  ImGui::SetNextItemWidth(box.width);
  context.places.set(id, box);
  ImGui::SliderFloat(("##" + std::string(id)).c_str(), &value, 0.0F, most, format);
}

void draw_opening(const PanelContext& context, Rect& rest) {
  auto opening = static_cast<float>(100.0 * context.state.jaws.opening);
  slider(context, rest, "opening", Text::kOpening, opening, 100.0F, "%.0f %%");
  context.state.jaws.opening = static_cast<double>(opening) / 100.0;
}

void draw_contact(const PanelContext& context, Rect& rest) {
  constexpr double kLeast_um = 1.0;
  auto contact_um = static_cast<float>(1e3 * context.state.jaws.contact_mm);
  slider(context, rest, "contact", Text::kContactBelow, contact_um, 200.0F, "%.0f \u00b5m");
  context.state.jaws.contact_mm = 1e-3 * std::max(static_cast<double>(contact_um), kLeast_um);
}

void draw_legend(const PanelContext& context, Rect& rest) {
  const std::array<LegendRow, 2> rows = {
      {{kPenetrationColor, context.text(Text::kLegendPenetration)},
       {kContactColor, context.text(Text::kLegendContact)}}};
  legend(context.theme, rest.take_top(context.px(46.0F), context.px(kGapXs)), rows);
  constexpr std::size_t kSteps = 12;
  std::array<Color, kSteps> colors;
  for (std::size_t i = 0; i < kSteps; ++i) {
    colors[i] = clearance_color(static_cast<double>(i) / (kSteps - 1));
  }
  const double contact_mm = context.state.jaws.contact_mm;
  const Rect box = rest.take_top(context.px(34.0F), context.px(kGapM));
  color_scale(context.theme, box,
              {colors, length_text(contact_mm), length_text((contact_mm + kFarClearance_mm) / 2.0),
               length_text(kFarClearance_mm)});
  hint_over(box, context.text(Text::kClearanceHint));
}

/// What makes a far side more certain.
std::string bite_advice(const AppView& view) {
  const OcclusionState& occlusion = view.occlusion;
  const std::string far = length_text(occlusion.far_uncertainty_mm);
  if (occlusion.bites_are_on_one_side) return view.texts.fill<Text::kBitesOnOneSide>(far);
  if (occlusion.bite_count > 1) return view.texts.fill<Text::kBothBitesUncertain>(far);
  const bool is_one_unfinished = std::any_of(
      io::kBites.begin(), io::kBites.end(),
      [&](io::ScanStage bite) { return progress_of(bite, view) == StageProgress::kScanned; });
  return is_one_unfinished ? view.texts.fill<Text::kFinishOtherBite>(far)
                           : view.texts.fill<Text::kFarSideUncertain>(far);
}

void draw_certainty(const PanelContext& context, Rect rest) {
  const OcclusionState& occlusion = context.view.occlusion;
  Rect rows = rest.take_top(2.0F * context.px(kValueRow), context.px(kGapS));
  const Rect both = rows;
  labeled_value(
      context.theme, rows.take_top(context.px(kValueRow)),
      context.text(occlusion.bite_count > 1 ? Text::kBetweenBites : Text::kBiteUncertainty),
      length_text(occlusion.middle_uncertainty_mm));
  labeled_value(
      context.theme, rows,
      context.view.texts.fill<Text::kFarUncertainty>(fmt::format("{:.0f}", occlusion.far_mm)),
      length_text(occlusion.far_uncertainty_mm));
  hint_over(both, context.text(Text::kUncertaintyOfBiteHint));
  if (occlusion.far_uncertainty_mm < kFarLimit_mm) return;
  draw_wrapped(rest, {context.theme.fonts.small, kCaution}, bite_advice(context.view));
}

void draw_pair(const PanelContext& context, Rect rest) {
  Rect row = rest.take_top(context.px(kTopButton), context.px(kGapS));
  const float width = (row.width - context.px(kGapS)) / 2.0F;
  small_action(context, row.take_left(width, context.px(kGapS)), Action::kJaws, {});
  small_action(context, row, Action::kClearance, {});
  if (shown_jaws(context.view, context.state) != nullptr) {
    draw_opening(context, rest);
    if (context.state.jaws.shows_clearance) {
      draw_contact(context, rest);
      draw_legend(context, rest);
    }
  }
  draw_certainty(context, rest);
}

}  // namespace

void draw_occlusion(const PanelContext& context, const Rect& box) {
  const OcclusionState& occlusion = context.view.occlusion;
  if (occlusion.is_running) return draw_running(context, box);
  if (!occlusion.failure.empty()) return draw_failure(context, box);
  if (occlusion.pair == nullptr) return draw_missing(context, box);
  draw_pair(context, box);
}

}  // namespace flytri::ui
