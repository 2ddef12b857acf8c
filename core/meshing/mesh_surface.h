/// @file  Makes a triangle mesh from points; unmeasured places stay open.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/point_cloud.h"
#include "core/meshing/surface_mesh.h"

namespace flytri::meshing {

struct MeshOptions {
  /// >= 0. Spacing of the mesh's vertices, mm. 0: 1.2 times the spacing of the points.
  double spacing_mm = 0.0;
  /// > 0. Standard deviation of the Gaussian weights of points, in spacings of the mesh. A smaller
  /// value keeps noise, a larger one rounds edges.
  double smoothing_spacings = 0.75;
  /// > 0. A place counts as measured if points within this radius, in spacings of the mesh,
  /// surround it. Gaps up to nearly twice this radius are closed, because they lie between lines.
  double support_spacings = 2.5;
  /// >= support_spacings. The same radius where the surface is smooth and nearly flat: there lines
  /// may be farther apart. Wider gaps stay open.
  double gap_spacings = 5.0;
  /// >= 0. Connected components with a smaller area, in squared spacings of the mesh, are dropped.
  double min_island_spacings2 = 150.0;

  /// >= 0. Strips of surface narrower than this are dropped, in spacings of the mesh: where the
  /// scan runs out, single lines stick out like a comb, and no crossing line confirms them. The
  /// rest gets smooth rims. 0: all stay.
  double min_strip_spacings = 16.0;
  /// >= 0. Holes up to this width are closed and marked as not measured, mm; see close_holes(). 0:
  /// all stay open, as nobody measured there.
  double close_holes_mm = 0.0;

  [[nodiscard]] Result<void> validate() const;
};

/// Makes a manifold mesh. Triangles are counter-clockwise seen from outside; vertices have the mean
/// normal, color and sigma of the points around them.
///
/// The surface is the zero of a weighted mean of the points' tangent planes, extracted by surface
/// nets on a sparse grid; vertices that the points do not surround are dropped, so that unmeasured
/// places stay open. The grid lies fixed in the world: the same points and spacing give the same
/// vertices, whatever points there are farther away.
/// @source  implicit surface: Kolluri, "Provably good moving least squares", SODA 2005; surface
///          nets: Gibson, MICCAI 1998. docs/adr/0003-meshing.md gives the reasons.
/// @param progress  advanced by one step
/// @errors  kBadOption; kInsufficient: too few points for a surface; kCancelled.
[[nodiscard]] Result<SurfaceMesh> mesh_surface(const PointCloud& points, const MeshOptions& options,
                                               const Workers& workers,
                                               const Progress& progress = {});

}  // namespace flytri::meshing
