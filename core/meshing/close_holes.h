/// @file  Closes small holes of a mesh by a smooth surface that is marked as not measured.
#pragma once

#include <cstddef>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// Closes small holes. Outer borders, wider holes, and rims of more than 400 vertices stay open.
/// The new surface continues the curvature around the hole. Its vertices are as dense as the rim,
/// have the colors of the rim, and are marked as not measured: sigma_mm is infinite.
/// @param mesh          an oriented manifold, and stays one; what it has stays as it is
/// @param max_width_mm  >= 0, see BoundaryLoop::width_mm; 0 closes nothing
/// @returns the number of holes that were closed
/// @source  triangles of least area: Barequet and Sharir, "Filling gaps in the boundary of a
///          polyhedron", 1995; refinement: Liepa, "Filling holes in meshes", SGP 2003; the surface
///          of least bending: Kobbelt et al., "Interactive multi-resolution modeling", SIGGRAPH
///          1998.
std::size_t close_holes(TriangleMesh& mesh, double max_width_mm);

}  // namespace flytri::meshing
