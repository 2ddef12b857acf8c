/// @file  The corners of a box, to be looked at from any side.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::ui {

/// @return  eight; none of an empty box
[[nodiscard]] inline std::vector<Vec3> corners_of(const Eigen::AlignedBox3d& box_mm) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8 && !box_mm.isEmpty(); ++i) {
    corners.emplace_back(box_mm.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
  return corners;
}

}  // namespace flytri::ui
