#include "ui/widgets/section_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flytri::ui {
namespace {

float px_per_mm(const Rect& box, const PlotFrame& frame) {
  return box.width / static_cast<float>(frame.width_mm);
}

/// Points closer than a pixel are passed over.
void draw_outline_of(const Theme& theme, const Rect& box, const PlotFrame& frame,
                     const review::Polyline& line) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::vector<ImVec2> corners;
  for (const review::MeasuredPoint& point : line.points) {
    const ImVec2 place = place_in_plot(box, frame, point.position_mm);
    const bool is_last = &point == &line.points.back();
    const bool is_far = corners.empty() || std::abs(place.x - corners.back().x) >= 1.0F ||
                        std::abs(place.y - corners.back().y) >= 1.0F;
    if (is_far || is_last) corners.push_back(place);
  }
  if (line.is_closed && !corners.empty()) corners.push_back(corners.front());
  const Rect near = box.inset(-theme.px(4.0F));
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const ImVec2 &a = corners[i], &b = corners[i + 1];
    if (!near.contains(a) && !near.contains(b)) continue;
    list.AddLine(a, b, to_u32(kNeutral), theme.px(2.0F));
  }
}

void draw_scale_bar(const Theme& theme, const Rect& box, const PlotFrame& frame) {
  const double length_mm = scale_bar_mm(0.4 * frame.width_mm);
  const float width = static_cast<float>(length_mm) * px_per_mm(box, frame);
  const float gap = theme.px(kGapS), thickness = theme.px(3.0F);
  const Rect bar = {box.x + gap, box.bottom() - gap - thickness, width, thickness};
  draw_box(bar, kText);
  const Rect label = {bar.x, bar.y - theme.px(20.0F), box.width / 2.0F, theme.px(18.0F)};
  draw_text(label, {theme.fonts.small, kText, Align::kLeft}, fmt::format("{:g} mm", length_mm));
}

void draw_points(const Theme& theme, const Rect& box, const PlotFrame& frame,
                 std::span<const Vec3> points_mm) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::vector<ImVec2> places;
  for (const Vec3& p_mm : points_mm) places.push_back(place_in_plot(box, frame, p_mm));
  if (places.size() == 2) list.AddLine(places[0], places[1], to_u32(kCaution), theme.px(1.5F));
  for (const ImVec2& place : places) {
    list.AddCircleFilled(place, theme.px(5.0F), to_u32(kBackground));
    list.AddCircleFilled(place, theme.px(4.0F), to_u32(kCaution));
  }
}

}  // namespace

ImVec2 place_in_plot(const Rect& box, const PlotFrame& frame, const Vec3& p_mm) {
  const Vec3 off_mm = p_mm - frame.middle_mm;
  const float scale = px_per_mm(box, frame);
  const ImVec2 middle = box.center();
  return {middle.x + scale * static_cast<float>(off_mm.dot(frame.right)),
          middle.y - scale * static_cast<float>(off_mm.dot(frame.up))};
}

Vec3 point_in_plot(const Rect& box, const PlotFrame& frame, const ImVec2& place) {
  const float scale = px_per_mm(box, frame);
  const ImVec2 middle = box.center();
  const auto x_mm = static_cast<double>((place.x - middle.x) / scale);
  const auto y_mm = static_cast<double>((middle.y - place.y) / scale);
  return frame.middle_mm + x_mm * frame.right + y_mm * frame.up;
}

double scale_bar_mm(double most_mm) {
  const double power = std::pow(10.0, std::floor(std::log10(most_mm)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= most_mm) return factor * power;
  }
  return power;
}

void section_plot(const Theme& theme, const Rect& box, const PlotFrame& frame,
                  const review::Section& outlines, std::span<const Vec3> points_mm) {
  draw_box(box, kBackground, theme.px(kGapXs));
  ImGui::PushClipRect(box.min(), box.max(), true);
  for (const review::Polyline& line : outlines) draw_outline_of(theme, box, frame, line);
  draw_points(theme, box, frame, points_mm);
  draw_scale_bar(theme, box, frame);
  ImGui::PopClipRect();
}

}  // namespace flytri::ui
