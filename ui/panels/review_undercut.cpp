/// @file  The undercut of a finished model in the side panel: the insertion axis, the legend, the
/// numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ui/panels/review_input.h"
#include "ui/panels/review_parts.h"
#include "ui/state/review_look.h"
#include "ui/widgets/badge.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kAxisRow = 36.0F, kSliderRow = 32.0F;
constexpr double kDegrees = 180.0 / std::numbers::pi;

bool axis_button(const PanelContext& context, const Rect& box, const char* id, Text label,
                 Text hint) {
  ButtonLook look;
  look.id = id;
  look.label = context.text(label);
  look.hint = context.text(hint);
  look.is_enabled = context.state.review.around_mm.has_value();
  context.places.set(id, box);
  return small_button(context.theme, box, look) && look.is_enabled;
}

void draw_axis(const PanelContext& context, Rect& rest) {
  Rect row = rest.take_top(context.px(kAxisRow), context.px(kGapS));
  const float width = std::floor((row.width - context.px(kGapXs)) / 2.0F);
  if (axis_button(context, row.take_left(width, context.px(kGapXs)), "axis_as_seen",
                  Text::kAxisAsSeen, Text::kAxisAsSeenHint)) {
    ask_for_undercut(context, context.state.view.camera.T_world_eye().linear().col(2));
  }
  if (axis_button(context, row, "find_axis", Text::kFindAxis, Text::kFindAxisHint))
    ask_for_undercut(context, std::nullopt);
}

/// The undercut is found anew when the slider is let go.
void draw_radius(const PanelContext& context, Rect& rest) {
  ReviewForm& form = context.state.review;
  draw_text(rest.take_top(context.px(20.0F), context.px(kGapXs)),
            {context.theme.fonts.small, kText, Align::kLeft},
            context.view.texts.fill<Text::kAroundClick>(fmt::format("{:.1f} mm", form.radius_mm)));
  const Rect box = rest.take_top(context.px(kSliderRow), context.px(kGapS));
  ImGui::SetCursorScreenPos(box.min());
  ImGui::SetNextItemWidth(box.width);
  context.places.set("radius", box);
  auto radius_mm = static_cast<float>(form.radius_mm);
  ImGui::SliderFloat("##radius", &radius_mm, 2.0F, 15.0F, "");
  form.radius_mm = std::clamp(std::round(10.0 * static_cast<double>(radius_mm)) / 10.0, 2.0, 15.0);
  if (!ImGui::IsItemDeactivatedAfterEdit() || !form.around_mm) return;
  const auto& map = context.view.review.undercut;
  const bool was_given = map != nullptr && !map->reviewed.found;
  ask_for_undercut(context, was_given ? std::optional(map->reviewed.axis) : std::nullopt);
}

void draw_depths(const PanelContext& context, Rect& rest) {
  const std::array<LegendRow, 1> rows = {{{kFreeColor, context.text(Text::kLegendFree)}}};
  const Rect free = rest.take_top(context.px(20.0F), context.px(kGapXs));
  legend(context.theme, free, rows);
  constexpr std::size_t kSteps = 12;
  std::array<Color, kSteps> colors;
  for (std::size_t i = 0; i < kSteps; ++i)
    colors[i] = undercut_color(static_cast<double>(i) / (kSteps - 1));
  const Rect box = rest.take_top(context.px(34.0F), context.px(kGapXs));
  color_scale(context.theme, box,
              {colors, "0", fmt::format("{:g} mm", kDeepUndercut_mm / 2.0),
               fmt::format("≥ {:g} mm", kDeepUndercut_mm)});
  hint_over(free, context.text(Text::kUndercutHint));
  hint_over(box, context.text(Text::kUndercutHint));
}

void draw_numbers(const PanelContext& context, Rect& rest, const UndercutMap& map) {
  const review::Undercut& undercut = map.reviewed.undercut;
  value_row(context, rest, Text::kUndercutArea, measured_text(undercut.area_mm2, 1.0, 2, "mm²"));
  value_row(context, rest, Text::kLookedAt, fmt::format("{:.1f} mm²", undercut.surface_mm2));
  value_row(context, rest, Text::kDeepest, fmt::format("{:.2f} mm", undercut.deepest_mm));
  if (map.reviewed.found) {
    value_row(context, rest, Text::kAxesAsGood,
              fmt::format("{:.1f}°", kDegrees * map.reviewed.found->equal_within_rad));
  }
}

}  // namespace

void draw_undercut(const PanelContext& context, Rect rest) {
  draw_axis(context, rest);
  draw_radius(context, rest);
  const ReviewState& review = context.view.review;
  if (failure_text(context, rest, Text::kNoUndercut, review.undercut_failure)) return;
  if (review.undercut == nullptr) return;
  draw_depths(context, rest);
  draw_numbers(context, rest, *review.undercut);
}

}  // namespace flytri::ui
