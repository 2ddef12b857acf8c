/// @file  Width of the place that a closed line encloses.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::meshing {

/// The largest circle that fits into a closed line.
struct WidestPlace {
  double width_mm = 0.0;  ///< its diameter; 0: the line encloses almost nothing
  Vec3 center_mm = Vec3::Zero();
};

/// Projects the line along a direction to an image with pixels of 0.02 mm or a thousandth of its
/// extent: the error of the width is about two pixels. Where the line crosses itself, an area that
/// it encloses twice counts as outside. The center has the height of the nearest part of the line.
/// @param rim_mm     corners of the line, the last joined to the first
/// @param islands_mm corners of closed lines around areas that do not belong to the place
/// @param direction  unit; zero if the line encloses no area in any direction
/// @source  distance to the rim: Felzenszwalb and Huttenlocher, "Distance transforms of sampled
///          functions", 2012, as in OpenCV.
[[nodiscard]] WidestPlace widest_place(std::span<const Vec3> rim_mm,
                                       std::span<const std::span<const Vec3>> islands_mm,
                                       const Vec3& direction);

}  // namespace flytri::meshing
