/// @file  The section of a finished model in the side panel: its picture, and distances in it.
#include <algorithm>
#include <cmath>
#include <optional>

#include "ui/panels/review_parts.h"
#include "ui/state/review_look.h"
#include "ui/widgets/section_plot.h"

namespace flytri::ui {
namespace {

constexpr float kRows = 2.0F * 24.0F, kHelp = 34.0F;
constexpr double kLeastWidth_mm = 2.0, kMostWidth_mm = 100.0, kPlotZoom = 1.15;

PlotFrame frame_of(const PanelContext& context, const review::Plane& plane) {
  const auto& jaw = context.view.scan->jaw;
  const SectionAxes axes = section_axes(plane, jaw ? &*jaw : nullptr);
  return {plane.point_mm, axes.right, axes.up, context.state.review.section_width_mm};
}

/// A third click begins anew.
void click(const PanelContext& context, const review::ReviewedSection& section, const Vec3& p_mm) {
  std::vector<Vec3>& points_mm = context.state.review.section_mm;
  if (points_mm.size() >= 2) points_mm.clear();
  points_mm.push_back(p_mm);
  if (points_mm.size() == 2) context.commands.emplace_back(CutSection{section.plane, points_mm});
}

void turn_plot_wheel(ReviewForm& form) {
  const auto wheel = static_cast<double>(ImGui::GetIO().MouseWheel);
  if (wheel == 0.0 || !ImGui::IsItemHovered()) return;
  form.section_width_mm = std::clamp(form.section_width_mm * std::pow(kPlotZoom, -wheel),
                                     kLeastWidth_mm, kMostWidth_mm);
}

/// The places of the clicks on the outline.
std::vector<Vec3> marks_of(const review::ReviewedSection& section,
                           const std::vector<Vec3>& clicked_mm) {
  std::vector<Vec3> marks_mm;
  marks_mm.reserve(clicked_mm.size());
  for (const Vec3& p_mm : clicked_mm)
    marks_mm.push_back(review::nearest_place(section.outlines, p_mm).point.position_mm);
  return marks_mm;
}

void draw_plot(const PanelContext& context, const Rect& box,
               const review::ReviewedSection& section) {
  const PlotFrame frame = frame_of(context, section.plane);
  touch_area("section_plot", box);
  context.places.set("section_plot", box);
  turn_plot_wheel(context.state.review);
  if (ImGui::IsItemActivated())
    click(context, section, point_in_plot(box, frame, ImGui::GetIO().MousePos));
  section_plot(context.theme, box, frame, section.outlines,
               marks_of(section, context.state.review.section_mm));
}

}  // namespace

void draw_section(const PanelContext& context, Rect rest) {
  const ReviewState& review = context.view.review;
  if (failure_text(context, rest, Text::kNoSection, review.section_failure)) return;
  if (review.section == nullptr) return;
  const review::ReviewedSection& section = *review.section;
  const float height = std::min(rest.width, rest.height - context.px(kRows + kHelp + kGapS));
  draw_plot(context, rest.take_top(height, context.px(kGapS)), section);
  if (section.places.size() < 2 || context.state.review.section_mm.size() < 2) {
    draw_wrapped(rest, {context.theme.fonts.small, kTextQuiet},
                 context.text(Text::kClickInSection));
    return;
  }
  value_row(
      context, rest, Text::kStraight,
      measured_mm_text(review::distance_mm(section.places[0].point, section.places[1].point)));
  value_row(
      context, rest, Text::kAlongSurface,
      section.along_mm ? measured_mm_text(*section.along_mm) : context.text(Text::kOtherOutline));
}

}  // namespace flytri::ui
