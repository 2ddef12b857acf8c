/// @file  From an implicit surface to triangles: surface nets on a sparse grid.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/meshing/implicit_surface.h"

namespace flytri::meshing {

/// Places one vertex on the surface in every grid cell that the surface crosses and the points
/// surround. Adds one quadrilateral (two triangles) at every crossed grid edge whose four cells
/// have a vertex. If a cell contains two sheets, the result may touch itself; see repair_manifold.
/// @param points      the points of the surface
/// @param spacing_mm  > 0, edge of a grid cell
/// @param progress    advanced by one step
/// @source  Gibson, "Constrained elastic surface nets", MICCAI 1998.
/// @errors  kCancelled.
[[nodiscard]] Result<TriangleMesh> extract_surface(const ImplicitSurface& surface,
                                                   const PointCloud& points, float spacing_mm,
                                                   const Workers& workers,
                                                   const Progress& progress);

}  // namespace flytri::meshing
