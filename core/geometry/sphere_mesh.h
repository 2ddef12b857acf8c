/// @file  A sphere as a mesh.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri {

/// A sphere that faces outwards, with `rings` rings of 2 `rings` facets; two poles are on z.
/// @param rings  >= 2
[[nodiscard]] TriangleMesh sphere_mesh(const Vec3& center_mm, double radius_mm, int rings);

}  // namespace flytri
