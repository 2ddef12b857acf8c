/// @file  How wide a hole is said to be, drawn, and flown to.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/meshing/surface_mesh.h"

namespace flytri::ui {

/// Diameter of the circle of its area. Its rim may be so ragged that the perimeter tells nothing.
[[nodiscard]] inline double hole_width_mm(const BoundaryLoop& hole) {
  return 2.0 * std::sqrt(std::max(hole.area_mm2, 0.0) / std::numbers::pi);
}

}  // namespace flytri::ui
