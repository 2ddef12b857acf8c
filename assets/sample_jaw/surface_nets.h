/// @file  Turns an implicit shape into triangles: a surface net (core/geometry/surface_net.h) with
/// each vertex at the mean of its cell's crossed edges.
#pragma once

#include <functional>

#include "core/geometry/triangle_mesh.h"

namespace flytri::sample_jaw {

/// Negative inside, positive outside, in mm; grows by at most 1.4 mm a mm.
using ImplicitShape = std::function<double(const Vec3&)>;

struct NetBox {
  Vec3 low_mm, high_mm;
  double cell_mm = 0.15;
};

/// The surface of `shape` inside the box, open where it leaves it. Positions and normals are set.
[[nodiscard]] TriangleMesh surface_nets(const ImplicitShape& shape, const NetBox& box);

}  // namespace flytri::sample_jaw
