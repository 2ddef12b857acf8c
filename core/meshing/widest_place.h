/// @file  How wide a place is that a closed line goes around.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::meshing {

/// The largest circle that fits into a closed line.
struct WidestPlace {
  double width_mm = 0.0;  ///< its diameter; 0: the line encloses next to nothing
  Vec3 center_mm = Vec3::Zero();
};

/// Sees the line along a direction, in pixels of 0.02 mm or a thousandth of its extent: the width
/// is exact to about two of them. Where the line crosses itself, what it encloses twice counts as
/// outside. The center lies as high along the direction as the line does where it is nearest.
/// @param rim_mm     corners of the line, the last joined to the first
/// @param islands_mm corners of lines around what does not belong to the place
/// @param direction  unit; zero where the line encloses nothing, seen from anywhere
/// @source  distance to the rim: Felzenszwalb and Huttenlocher, "Distance transforms of sampled
///          functions", 2012, as in OpenCV.
[[nodiscard]] WidestPlace widest_place(std::span<const Vec3> rim_mm,
                                       std::span<const std::span<const Vec3>> islands_mm,
                                       const Vec3& direction);

}  // namespace flytri::meshing
