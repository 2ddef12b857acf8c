/// @file  From points to triangles: a mesh of the measured surface that leaves unmeasured places
/// open.
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
  /// > 0. Standard deviation of the Gaussian that weighs the points around a place, in spacings of
  /// the mesh. Smaller keeps noise, larger rounds edges.
  double smoothing_spacings = 0.75;
  /// > 0. Radius, in spacings of the mesh, within which points must surround a place for it to be
  /// measured. Gaps up to nearly twice as wide lie between lines and are closed.
  double support_spacings = 2.5;
  /// >= support_spacings. The same where the surface is smooth and faces one way: there lines may
  /// lie farther apart. Wider gaps stay open.
  double gap_spacings = 5.0;
  /// >= 0. Connected pieces with less area, in squared spacings of the mesh, are dropped.
  double min_island_spacings2 = 150.0;

  [[nodiscard]] Result<void> validate() const;
};

/// Makes a mesh that is manifold and counter-clockwise from outside, with vertices on the surface
/// that the points sample. Vertices carry normal, color and sigma of the points around them.
///
/// The surface is the zero of a weighted mean of the points' tangent planes, extracted by surface
/// nets on a sparse grid; vertices that the points do not surround are left out, so nothing is
/// bridged.
/// @source  implicit surface: Kolluri, "Provably good moving least squares", SODA 2005; surface
///          nets: Gibson, MICCAI 1998. Why these: docs/adr/0003-meshing.md.
/// @param progress  advanced by one step
/// @errors  kBadOption; kInsufficient: fewer points than a patch of surface needs; kCancelled.
[[nodiscard]] Result<SurfaceMesh> mesh_surface(const PointCloud& points, const MeshOptions& options,
                                               const Workers& workers,
                                               const Progress& progress = {});

}  // namespace flytri::meshing
