/// @file  Closes small holes of a mesh by a smooth surface that is marked as not measured.
#pragma once

#include <cstddef>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// Closes each hole up to a width; wider ones and outer borders stay open, also holes with a rim of
/// more than 400 vertices. The new vertices have the mean distance of those at the rim. Their
/// surface continues the curvature around the hole; their colors come from the rim, and sigma_mm is
/// infinite: not measured.
/// @param mesh          an oriented manifold, and stays one; what it has stays as it is
/// @param max_width_mm  of the largest circle inside a hole, see BoundaryLoop::width_mm; >= 0, and
/// 0
///                      closes nothing
/// @returns the number of holes that were closed
/// @source  triangles of least area: Barequet and Sharir, "Filling gaps in the boundary of a
///          polyhedron", 1995; refinement: Liepa, "Filling holes in meshes", SGP 2003; the surface
///          of least bending: Kobbelt et al., "Interactive multi-resolution modeling", SIGGRAPH
///          1998.
std::size_t close_holes(TriangleMesh& mesh, double max_width_mm);

}  // namespace flytri::meshing
