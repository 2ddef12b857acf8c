/// @file  Trims the rims of a mesh: combs, whiskers and thin bridges go, smooth rims are left.
#pragma once

#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// At its rims a scan ends in single lines, which no other line confirms. In this order:
/// - from the rims inwards, drops what only one pattern measured (SurfacePoint::patterns);
/// - drops strips that are narrower than a width, and small pieces;
/// - smooths the rims along the surface.
/// If less than half would be left, as of a very short scan, the mesh stays as it is. Holes smaller
/// than the width are rims only next to one: nothing around other pinholes is lost.
/// @param mesh        an oriented manifold, and stays one
/// @param strip_mm    > 0
/// @param spacing_mm  > 0, of the vertices: a rim moves by at most half of it
/// @source  opening by a disk: Serra, "Image Analysis and Mathematical Morphology", 1982.
void trim_rims(TriangleMesh& mesh, float strip_mm, float spacing_mm, const Workers& workers);

}  // namespace flytri::meshing
