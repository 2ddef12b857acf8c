/// @file  The outlines of a section in their plane, with a scale bar.
#pragma once

#include <span>
#include <vector>

#include "core/review/section.h"
#include "ui/widgets/draw.h"

namespace flytri::ui {

/// What part of the plane the picture shows, and how it lies. World frame.
struct PlotFrame {
  Vec3 middle_mm = Vec3::Zero();
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY();  ///< unit, in the plane
  double width_mm = 16.0;                          ///< > 0
};

[[nodiscard]] ImVec2 place_in_plot(const Rect& box, const PlotFrame& frame, const Vec3& p_mm);
/// The point of the plane at a place in the box.
[[nodiscard]] Vec3 point_in_plot(const Rect& box, const PlotFrame& frame, const ImVec2& place);

/// The length of a scale bar: 1, 2 or 5 times a power of ten, at most `most_mm`.
[[nodiscard]] double scale_bar_mm(double most_mm);

/// @param points_mm  that were clicked; two are connected
void section_plot(const Theme& theme, const Rect& box, const PlotFrame& frame,
                  const review::Section& outlines, std::span<const Vec3> points_mm);

}  // namespace flytri::ui
