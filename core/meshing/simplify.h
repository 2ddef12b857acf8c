/// @file  Takes triangles away where the surface does not need them, within a bound of the error.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

struct SimplifyOptions {
  /// > 0. The places of all vertices are at most so far from the simplified surface, root mean
  /// square, mm.
  double max_rms_mm = 0.002;
  /// > 0. None of them is farther, mm.
  double max_mm = 0.010;
  /// > 0. The line along a seam of the texture moves by no more, mm.
  double max_seam_mm = 0.010;
  /// [0, pi/6]. No new triangle has a smaller angle, unless one that it replaces had.
  double least_angle_rad = 0.35;

  [[nodiscard]] Result<void> validate() const;
};

/// A mesh with fewer triangles.
struct Simplified {
  std::vector<Triangle> triangles;  ///< of vertices of the mesh as it was
  double rms_mm = 0.0;              ///< distance of the vertices of the mesh to this surface
  double max_mm = 0.0;              ///< the largest of these distances
};

/// Moves vertices onto neighbors, those first that cost least by the planes around them, until a
/// limit stands against every further step. What stays is a subset of the vertices, with all their
/// data.
/// @param mesh  an oriented manifold. Vertices at the same position belong together: they are the
///              two sides of a seam of the texture
/// @param progress  advanced by one step
/// @source  order: Garland and Heckbert, "Surface simplification using quadric error metrics",
///          SIGGRAPH 1997. docs/adr/0013-simplification.md gives the reasons.
/// @errors  kBadOption, kCancelled.
[[nodiscard]] Result<Simplified> simplify(const TriangleMesh& mesh, const SimplifyOptions& options,
                                          const Progress& progress = {});

}  // namespace flytri::meshing
