/// @file  A few clicks near the edge of a preparation -> its margin line.
#pragma once

#include <span>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/review/edge_fit.h"
#include "core/review/edge_path.h"
#include "core/review/measure.h"
#include "core/review/section.h"

namespace flytri::review {

struct MarginOptions {
  EdgePathOptions path;
  EdgeFitOptions fit;
  /// Default 0.1, > 0. Distance of the line's points, mm.
  double step_mm = 0.1;
  /// Default 0.4, >= step_mm. The line is smoothed by parabolas over this far to both sides, mm.
  double smooth_mm = 0.4;
  /// Default 0.05, > 0. A point farther from its neighbors' parabola counts less, mm.
  double outlier_mm = 0.05;

  [[nodiscard]] Result<void> validate() const;
};

struct Margin {
  Polyline line;            ///< closed, on the surface; sigma across the line, before smoothing
  double edge_share = 0.0;  ///< of its points where the surface has an edge; the others are between
  double least_turn_rad = 0.0;  ///< of these edges: how blunt the bluntest one is
};

/// Follows the edge from click to click over the mesh, then moves each point to where the flanks
/// beside it meet, finer than the triangles, and from there onto the surface.
/// @param mesh  welded, with unit normals
/// @param clicks_mm  three or more, in order along the edge, each within the snap distance of it
/// @errors  as edge_path; kInsufficient: less than half of the line is an edge.
[[nodiscard]] Result<Margin> find_margin(const TriangleMesh& mesh, std::span<const Vec3> clicks_mm,
                                         const MarginOptions& options, const Workers& workers);

}  // namespace flytri::review
