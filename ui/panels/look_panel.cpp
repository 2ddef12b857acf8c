/// @file  Buttons for colors, with their legend, and for the sides to look from.
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels/panels.h"
#include "ui/scene/scene_options.h"
#include "ui/state/jaw_words.h"
#include "ui/state/jaws_look.h"
#include "ui/widgets/badge.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kWidth = 168.0F;
constexpr float kLookButton = 44.0F;
constexpr float kSideButton = 35.0F;

void draw_modes(const PanelContext& context, Rect& rest) {
  for (const Action action :
       {Action::kShading, Action::kTexture, Action::kCoverage, Action::kUncertainty}) {
    small_action(context, rest.take_top(context.px(kLookButton), context.px(kGapXs)), action, {});
  }
}

/// Share of the surfels. Of every scan some tenth of a percent is hidden at the rims.
constexpr double kWorthShowing = 0.003;

/// Of a tongue or a finger that was in the way.
bool offers_crossed(const PanelContext& context) {
  const scan::ScanSnapshot* scan = context.view.scan.get();
  if (scan == nullptr || scan->phase == scan::ScanPhase::kFinished) return false;
  const double least = kWorthShowing * static_cast<double>(surfel_count(scan->model));
  return scan->shows_crossed || static_cast<double>(scan->crossed_count) > least;
}

void draw_blend(const PanelContext& context, Rect& rest) {
  Rect box = rest.take_top(context.px(64.0F));
  draw_text(box.take_top(context.px(20.0F), context.px(kGapXs)),
            {context.theme.fonts.small, kText, Align::kLeft},
            context.view.texts.fill<Text::kTextureStrength>(", ."));
  ImGui::SetCursorScreenPos(box.min());
  ImGui::SetNextItemWidth(box.width);
  context.places.set("blend", {box.x, box.y, box.width, context.px(36.0F)});
  auto blend = static_cast<float>(100.0 * context.state.texture_blend);
  if (ImGui::SliderFloat("##blend", &blend, 0.0F, 100.0F, "%.0f %%")) {
    context.state.texture_blend = static_cast<double>(blend) / 100.0;
  }
}

void draw_coverage_legend(const PanelContext& context, Rect& rest) {
  const SceneOptions colors;
  const std::array<LegendRow, 3> rows = {{{colors.good_color, context.text(Text::kLegendGood)},
                                          {colors.thin_color, context.text(Text::kLegendScanAgain)},
                                          {kHole, context.text(Text::kLegendHole), true}}};
  legend(context.theme, rest.take_top(context.px(70.0F)), rows);
}

void draw_sigma_legend(const PanelContext& context, Rect& rest) {
  constexpr std::size_t kSteps = 12;
  std::array<Color, kSteps> colors;
  for (std::size_t i = 0; i < kSteps; ++i) {
    colors[i] = sigma_color(static_cast<double>(i) / (kSteps - 1));
  }
  const double most_mm = max_sigma_mm(context.view.volume_mm);
  const Rect box = rest.take_top(context.px(34.0F));
  color_scale(context.theme, box,
              {colors, length_text(most_mm / kSigmaRange),
               length_text(most_mm / std::sqrt(kSigmaRange)), length_text(most_mm)});
  hint_over(box, context.text(Text::kUncertaintyHint));
}

/// Height of a plate with some rows of buttons, in units.
constexpr float height_of(float rows, float button) {
  return rows * button + (rows - 1.0F) * kGapXs + 2.0F * kGapS;
}

/// Height of the legend or slider under the buttons, in units.
float extra_height(ColorMode mode) {
  switch (mode) {
    case ColorMode::kTexture:
      return 64.0F + kGapS;
    case ColorMode::kCoverage:
      return 70.0F + kGapS;
    case ColorMode::kUncertainty:
      return 34.0F + kGapS;
    case ColorMode::kShading:
    case ColorMode::kClearance:
    case ColorMode::kUndercut:
      break;
  }
  return 0.0F;
}

/// Below the banner.
float top_of(const PanelContext& context) {
  return context.layout.frame.y + context.px(kBannerHeight) + context.px(kGapM);
}

void draw_colors(const PanelContext& context) {
  const Rect box = colors_box(context);
  const Plate plate("colors", box, overlay(context.theme));
  Rect rest = box.inset(context.px(kGapS));
  draw_modes(context, rest);
  rest.take_top(context.px(kGapXs));
  const ColorMode colors = shown_colors(context.view, context.state);
  if (colors == ColorMode::kTexture) draw_blend(context, rest);
  if (colors == ColorMode::kCoverage) draw_coverage_legend(context, rest);
  if (colors == ColorMode::kUncertainty) draw_sigma_legend(context, rest);
}

void draw_sides(const PanelContext& context) {
  const Rect box = sides_box(context);
  const Plate plate("sides", box, overlay(context.theme));
  Rect rest = box.inset(context.px(kGapS));
  const auto row = [&] { return rest.take_top(context.px(kSideButton), context.px(kGapXs)); };
  const ActionLook all = {nullptr, context.text(Text::kViewAll)};
  const auto draw_crossed = [&] {
    if (!offers_crossed(context)) return;
    small_action(context, row(), Action::kShowCrossed, {nullptr, context.text(Text::kHasGone)});
  };
  if (context.view.stage == io::ScanStage::kFace) {
    small_action(context, row(), Action::kShowAll, all);
    return draw_crossed();
  }
  const auto& jaw = context.view.scan == nullptr ? std::nullopt : context.view.scan->jaw;
  small_action(context, row(), Action::kOcclusal, {nullptr, context.text(Text::kViewOcclusal)});
  small_action(context, row(), Action::kBuccal,
               {nullptr, context.text(jaw && jaw->is_arch ? Text::kViewFront : Text::kViewBuccal)});
  Rect pair = row();
  const ActionLook right = {.label = context.text(Text::kViewRight), .shows_key = false};
  small_action(context,
               pair.take_left((pair.width - context.px(kGapXs)) / 2.0F, context.px(kGapXs)),
               Action::kRightSide, right);
  small_action(context, pair, Action::kLeftSide,
               {.label = context.text(Text::kViewLeft), .shows_key = false});
  small_action(context, row(), Action::kLingual,
               {nullptr, context.text(lingual_name(jaw_of(context.view.stage)))});
  small_action(context, row(), Action::kShowAll, all);
  draw_crossed();
}

/// Two buttons side by side hold their labels.
float sides_width(const PanelContext& context) {
  float label = 0.0F;
  for (const Text text : {Text::kViewRight, Text::kViewLeft}) {
    label = std::max(label, text_width(context.theme.fonts.strong, context.text(text)));
  }
  const float button = std::ceil(label) + 2.0F * context.px(12.0F);
  return std::max(2.0F * button + context.px(kGapXs + 2.0F * kGapS), context.px(144.0F));
}

}  // namespace

Rect colors_box(const PanelContext& context) {
  const float height =
      height_of(4.0F, kLookButton) + extra_height(shown_colors(context.view, context.state));
  return {context.layout.picture.x + context.px(kGapM), top_of(context), context.px(kWidth),
          context.px(height)};
}

Rect sides_box(const PanelContext& context) {
  const float width = sides_width(context);
  const float rows = (context.view.stage == io::ScanStage::kFace ? 1.0F : 5.0F) +
                     (offers_crossed(context) ? 1.0F : 0.0F);
  return {context.layout.picture.right() - context.px(kGapM) - width, top_of(context), width,
          context.px(height_of(rows, kSideButton))};
}

void draw_look_panel(const PanelContext& context) {
  if (context.phase() == scan::ScanPhase::kContinuation) return;
  draw_colors(context);
  draw_sides(context);
}

}  // namespace flytri::ui
