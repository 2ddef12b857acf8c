/// @file  Small meshes with a known shape, for tests.
#pragma once

#include <functional>

#include "core/geometry/triangle_mesh.h"

namespace flytri {

struct HeightFieldSize {
  double half_width_mm = 10.0;
  double step_mm = 0.25;
};

/// The surface z = depth(x, y) over a square around the origin, facing -z (towards a sensor).
[[nodiscard]] TriangleMesh height_field(const HeightFieldSize& size,
                                        const std::function<double(double, double)>& depth);

}  // namespace flytri
