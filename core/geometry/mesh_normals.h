/// @file  Normals and areas of triangles, and vertex normals of a mesh that comes without.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri {

/// Along the triangle's normal, outwards; as long as its area.
[[nodiscard]] Vec3 area_vector_mm2(const TriangleMesh& mesh, const Triangle& triangle);

/// Sets every vertex normal to the mean of its triangles' normals, weighted by their areas.
/// A vertex of no triangle, or of degenerate ones alone, gets +z.
void compute_vertex_normals(TriangleMesh& mesh);

}  // namespace flytri
