/// @file  Which triangles meet where: makes a mesh manifold, drops its islands, finds its rims.
#pragma once

#include <vector>

#include "core/meshing/surface_mesh.h"

namespace flytri::meshing {

/// Drops degenerate triangles and those around an edge that more than two triangles share, or two
/// in the same sense; then gives every fan of triangles at a vertex a vertex of its own. What is
/// left is an oriented manifold with boundary.
void repair_manifold(TriangleMesh& mesh);

/// Drops connected pieces with less area, then vertices that no triangle uses.
void drop_islands(TriangleMesh& mesh, double min_area_mm2);

/// The mesh whose cuts are closed again: vertices at the very same place become one.
[[nodiscard]] TriangleMesh welded(const TriangleMesh& cut);

/// The rims of an oriented manifold, the largest area first. Of each connected piece the one
/// that encloses the largest area is its outer border.
[[nodiscard]] std::vector<BoundaryLoop> find_boundaries(const TriangleMesh& mesh);

}  // namespace flytri::meshing
