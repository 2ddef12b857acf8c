/// @file  Trims the rims of a mesh: combs, whiskers and thin bridges go, smooth rims are left.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// Where the scan runs out, single lines end one beside the other: nothing crosses and confirms
/// them. From the rims inwards, this drops what lines of one pattern alone measured
/// (SurfacePoint::patterns), then strips of surface that are narrower than a width, and pieces that
/// are hardly larger. At last it smooths the rims along the surface. A scan of a moment, of which
/// less than half would be left, stays as it is. Holes smaller across than the width do not count
/// as rims, so that pinholes cost nothing around them.
/// @param mesh        an oriented manifold, and stays one
/// @param strip_mm    > 0
/// @param spacing_mm  > 0, of the vertices: a rim moves by at most half of it
/// @source  opening by a disk: Serra, "Image Analysis and Mathematical Morphology", 1982.
void trim_rims(TriangleMesh& mesh, float strip_mm, float spacing_mm);

}  // namespace flytri::meshing
