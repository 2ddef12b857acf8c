/// @file  Normals and areas of triangles; computes missing vertex normals.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri {

/// A vector along the triangle's outward normal. Its length is the area.
[[nodiscard]] Vec3 area_vector_mm2(const TriangleMesh& mesh, const Triangle& triangle);

/// Sets every vertex normal to the mean of its triangles' normals, weighted by their areas. A
/// vertex without triangles, or with only degenerate ones, gets +z.
void compute_vertex_normals(TriangleMesh& mesh);

}  // namespace flytri
