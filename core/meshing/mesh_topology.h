/// @file  Topology of a mesh: makes it manifold, drops small components, finds its boundaries.
#pragma once

#include <vector>

#include "core/meshing/disjoint_sets.h"
#include "core/meshing/surface_mesh.h"

namespace flytri::meshing {

/// Drops degenerate triangles and all triangles at an edge that has more than two triangles or two
/// with the same direction. Then gives each fan of triangles at a vertex its own vertex. The result
/// is an oriented manifold with boundary.
void repair_manifold(TriangleMesh& mesh);

/// Gives each fan of triangles at a vertex its own vertex: after triangles of a manifold were
/// dropped, it is one again.
void split_fans(TriangleMesh& mesh);

/// Corners (3 t + k) at a vertex whose triangles share an edge there: each set is one fan.
[[nodiscard]] DisjointSets fans_of(const TriangleMesh& mesh);

/// The connected components, as sets of vertices.
[[nodiscard]] DisjointSets pieces_of(const TriangleMesh& mesh);

/// Drops vertices that no triangle has; the others keep their order.
void drop_unused_vertices(TriangleMesh& mesh);

/// Drops connected components with a smaller area, then unused vertices.
void drop_islands(TriangleMesh& mesh, double min_area_mm2);

/// Joins vertices at exactly the same position, which closes the cuts between charts.
[[nodiscard]] TriangleMesh welded(const TriangleMesh& cut);

/// Keeps the marked triangles, parallel to the mesh's, and drops the others; vertices stay.
void keep_triangles(TriangleMesh& mesh, const std::vector<char>& keep);

/// The vertices along each boundary of an oriented manifold, in order.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> boundary_lines(const TriangleMesh& mesh);

/// The boundary loops of an oriented manifold, largest area first. In each connected component, the
/// loop with the largest area is the outer border.
[[nodiscard]] std::vector<BoundaryLoop> find_boundaries(const TriangleMesh& mesh);

}  // namespace flytri::meshing
