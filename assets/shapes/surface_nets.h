/// @file  Turns an implicit shape into triangles: a surface net (core/geometry/surface_net.h) with
/// each vertex at the mean of its cell's crossed edges.
#pragma once

#include <functional>

#include "core/geometry/triangle_mesh.h"

namespace flytri::shapes {

/// Negative inside, positive outside, in mm; its gradient is at most 1.4.
using ImplicitShape = std::function<double(const Vec3&)>;

struct NetBox {
  Vec3 low_mm, high_mm;
  double cell_mm = 0.15;
};

/// The surface of `shape` inside the box, open at the box's sides. Sets positions and normals.
[[nodiscard]] TriangleMesh surface_nets(const ImplicitShape& shape, const NetBox& box);

}  // namespace flytri::shapes
