/// @file  From an implicit surface to triangles: surface nets on a sparse grid.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/meshing/implicit_surface.h"

namespace flytri::meshing {

/// One vertex in every grid cell that the surface crosses and the points surround, moved onto the
/// surface; one quadrilateral, as two triangles, across every crossed grid edge whose four cells
/// have one. Where a cell holds two sheets the result may touch itself; see repair_manifold.
/// @param points      the surface's own
/// @param spacing_mm  > 0, edge of a grid cell
/// @param progress    advanced by one step
/// @source  Gibson, "Constrained elastic surface nets", MICCAI 1998.
/// @errors  kCancelled.
[[nodiscard]] Result<TriangleMesh> extract_surface(const ImplicitSurface& surface,
                                                   const PointCloud& points, float spacing_mm,
                                                   const Workers& workers,
                                                   const Progress& progress);

}  // namespace flytri::meshing
