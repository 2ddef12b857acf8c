/// @file  The panel at the right: live image, distance of the sensor, alignment error.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/panels/panels.h"
#include "ui/panels/stage_row.h"
#include "ui/scene/scene_options.h"
#include "ui/state/jaws_look.h"
#include "ui/state/review_look.h"
#include "ui/theme/icons.h"
#include "ui/widgets/distance_bar.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"
#include "ui/widgets/volume_preview.h"

namespace flytri::ui {
namespace {

constexpr float kSideCaption = 18.0F;
constexpr float kPictureRatio = 0.75F;
constexpr float kHandRow = 44.0F, kDistanceRow = 70.0F, kFigureRows = 48.0F;

/// The later of the two measurement frames.
std::shared_ptr<const scan::LiveFrame> latest_frame(const AppView& view) {
  if (view.scan == nullptr) return nullptr;
  const auto& [vertical, horizontal] = view.scan->latest;
  if (vertical == nullptr) return horizontal;
  if (horizontal == nullptr) return vertical;
  return vertical->frame.time_s > horizontal->frame.time_s ? vertical : horizontal;
}

const char* missing_text(const AppView& view) {
  return view.texts[view.source.is_lost ? Text::kNoSensor : Text::kNoImageYet];
}

/// Dragging the live image moves the simulated sensor; the wheel moves it closer or away.
void steer(const PanelContext& context, const Rect& image) {
  const auto& hand = context.view.source.hand;
  if (!hand || hand->follows_path) return;
  touch_area("live_image", image);
  const ImGuiIO& io = ImGui::GetIO();
  const double mm_per_px = context.view.volume_mm.x() / static_cast<double>(image.width);
  Vec3 move_mm = Vec3::Zero();
  if (ImGui::IsItemActive()) move_mm = Vec3(-io.MouseDelta.x, -io.MouseDelta.y, 0.0) * mm_per_px;
  if (ImGui::IsItemHovered()) {
    move_mm.z() = static_cast<double>(io.MouseWheel) * context.view.volume_mm.z() / 20.0;
  }
  if (!move_mm.isZero()) context.commands.emplace_back(SteerHand{move_mm, Vec3::Zero()});
}

void draw_live_image(const PanelContext& context, const Rect& box) {
  CameraPicture& picture = context.pictures.live;
  picture.show(latest_frame(context.view));
  const Rect image = show_camera_image(context, box, picture, missing_text(context.view));
  context.places.set("live_image", image);
  steer(context, image);
}

void draw_source(const PanelContext& context, const Rect& row) {
  const SourceState& source = context.view.source;
  const Theme& theme = context.theme;
  Rect rest = row;
  const std::string played =
      source.played_share ? fmt::format("{:.0f} %", 100.0 * *source.played_share) : "";
  draw_text(rest.take_right(text_width(theme.fonts.small, played), context.px(kGapS)),
            {theme.fonts.small, kTextQuiet, Align::kRight}, played);
  draw_text(rest, {theme.fonts.small, kTextQuiet, Align::kLeft},
            context.view.texts.translated(source.name));
}

/// Buttons of the simulated sensor: move it by hand, lift it.
void draw_hand(const PanelContext& context, Rect row) {
  const float width = (row.width - context.px(kGapS)) / 2.0F;
  const bool is_away = context.view.source.hand->is_taken_away;
  small_action(context, row.take_left(width, context.px(kGapS)), Action::kHandMode,
               {nullptr, context.text(Text::kByHand)});
  small_action(
      context, row, Action::kLiftSensor,
      {nullptr, context.text(is_away ? Text::kReturnSensor : Text::kLiftSensor), false, kCaution});
}

/// Of a finished model: how certain its longest distance is.
void draw_span(const PanelContext& context, Rect rest, const reconstruct::JudgedSpan& judged) {
  constexpr double kToMicrons = 1e3;
  const Rect both = rest;
  context.places.set("span", both);
  labeled_value(context.theme, rest.take_top(context.px(24.0F)),
                sentence(std::string(context.view.texts.translated(name_of(judged.span)))),
                fmt::format("{:.3f} mm", judged.span.ends.length_mm()));
  labeled_value(context.theme, rest, context.text(Text::kSpanUncertainty),
                fmt::format("\u00b1 {:.0f} \u00b5m", std::ceil(kToMicrons * judged.range95_mm())));
  hint_over(both, context.text(Text::kSpanHint));
}

void draw_figures(const PanelContext& context, Rect rest) {
  const auto& scan = context.view.scan;
  if (scan != nullptr && scan->result != nullptr && !scan->result->spans.empty())
    return draw_span(context, rest, scan->result->spans.front());
  const float row = context.px(24.0F);
  const bool has_residual = scan != nullptr && scan->residual_mm.has_value();
  const Rect alignment = rest.take_top(row), delay = rest.take_top(row);
  labeled_value(context.theme, alignment, context.text(Text::kAlignmentError),
                has_residual ? length_text(*scan->residual_mm) : "\u2013");
  const bool is_known = scan != nullptr && scan->latency.count > 0;
  labeled_value(context.theme, delay, context.text(Text::kDelay),
                is_known ? fmt::format("{:.0f} ms", 1e3 * scan->latency.median_s) : "\u2013");
  hint_over(alignment, context.view.texts.fill<Text::kAlignmentErrorHint>(
                           length_text(max_sigma_mm(context.view.volume_mm))));
  hint_over(delay, context.text(Text::kDelayHint));
}

void draw_preview(const PanelContext& context, Rect rest) {
  if (rest.height < context.px(96.0F)) return;
  const Theme& theme = context.theme;
  draw_text(rest.take_top(context.px(kSideCaption), context.px(kGapXs)),
            {theme.fonts.small, kTextQuiet, Align::kLeft}, context.text(Text::kLatestLines));
  std::array<std::shared_ptr<const View>, 2> views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto& frame = context.view.scan == nullptr ? nullptr : context.view.scan->latest[i];
    if (frame != nullptr) views[i] = frame->view;
  }
  volume_preview(theme, rest, context.view.volume_mm, views);
}

void draw_ordinary(const PanelContext& context, Rect rest) {
  const float gap = context.px(kGapM);
  draw_source(context, rest.take_top(context.px(kSideCaption), context.px(kGapXs)));
  // The image gives way where the window is low.
  const float hand = context.view.source.hand ? context.px(kHandRow) + gap : 0.0F;
  const float others = gap + hand + context.px(kDistanceRow) + gap + context.px(kFigureRows);
  draw_live_image(context,
                  rest.take_top(std::min(rest.width * kPictureRatio, rest.height - others), gap));
  if (context.view.source.hand) draw_hand(context, rest.take_top(context.px(kHandRow), gap));
  const auto distance = context.view.scan == nullptr ? std::nullopt : context.view.scan->distance;
  const Rect bar = rest.take_top(context.px(kDistanceRow), gap);
  distance_bar(context.theme, bar, distance, context.view.texts);
  hint_over(bar, context.text(Text::kDistanceHint));
  draw_figures(context, rest.take_top(context.px(kFigureRows), gap));
  const bool is_finished = context.phase() == scan::ScanPhase::kFinished;
  if (is_finished && context.view.stage != io::ScanStage::kFace && rest.height >= context.px(44.0F))
    small_action(context, rest.take_top(context.px(44.0F), gap), Action::kOcclusalPlane, {});
  draw_preview(context, rest);
}

}  // namespace

void draw_side_panel(const PanelContext& context) {
  const Plate plate("side", context.layout.side);
  Rect inner = context.layout.side.inset(context.px(kGapM));
  if (context.phase() == scan::ScanPhase::kContinuation) {
    context.pictures.live.show(latest_frame(context.view));
    draw_continuation(context, inner);
    return;
  }
  if (is_reviewing(context.view, context.state)) {
    draw_review(context, inner);
    return;
  }
  draw_stage_row(context, inner);
  if (shows_finished_bite(context.view)) {
    draw_occlusion(context, inner);
  } else {
    draw_ordinary(context, inner);
  }
}

}  // namespace flytri::ui
