/// @file  The surface around a place near an edge -> where its two flanks meet.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/point_grid.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::review {

struct EdgeFitOptions {
  /// Default 0.1, > 0. Surface nearer to the edge does not count, mm: there it is rounded.
  double gap_mm = 0.1;
  /// Default 0.45, > gap_mm. Nor does surface farther away, mm: a shoulder is that wide.
  double reach_mm = 0.45;
  /// Default 0.15, > 0. Surface up to this far along the edge counts, mm.
  double half_width_mm = 0.15;
  /// Default 0.6, > 0. Flanks bend: standard deviation of the quadratic term, 1/mm. 0.6 is that of
  /// a radius of 0.8 mm, as a chamfer has.
  double bend_per_mm = 0.6;
  /// Default 0.35, > 0. Flanks that turn by less are no edge, rad (20 degrees).
  double least_turn_rad = 0.35;

  [[nodiscard]] Result<void> validate() const;
};

/// Samples of the surface near a line, for fits at its places. Immutable; queries are thread-safe.
class EdgeSurface {
 public:
  /// @param mesh  indices valid
  /// @param line_mm  only surface near these points is taken
  EdgeSurface(const TriangleMesh& mesh, std::span<const Vec3> line_mm,
              const EdgeFitOptions& options);

  struct Edge {
    Vec3 place_mm = Vec3::Zero();  ///< where both flanks, continued, meet
    double sigma_mm = 0.0;  ///< standard uncertainty across the edge, RMS of its two directions
    double turn_rad = 0.0;  ///< between the normals of the flanks
  };
  /// Fits a parabola to each flank, seen along the edge, by weighted least squares with a prior for
  /// how much it bends, and continues both to the edge. None if there is too little surface, or no
  /// edge that stands out.
  /// @param place_mm  at most about reach_mm - gap_mm from the edge
  /// @param along  unit, along the edge
  /// @source  Bayesian linear regression: Bishop, "Pattern Recognition and Machine Learning", 2006,
  ///          section 3.3. sigma_mm is from its posterior covariance, with two triangles counted as
  ///          one independent point (a mesh has half as many vertices), and with the larger of the
  ///          sigma of the vertices and what the fit leaves.
  [[nodiscard]] std::optional<Edge> fit(const Vec3& place_mm, const Vec3& along) const;

 private:
  struct Sample {
    Vec3 position_mm;
    Vec3 normal;
    double area_mm2 = 0.0;
    double sigma_mm = 0.0;
    std::uint32_t triangle = 0;
  };
  /// A sample seen along the edge: x across, y out of the surface, from the place.
  struct Seen {
    Vec2 at_mm;
    const Sample* sample;
  };
  /// The tangent of a flank at the edge.
  struct Flank {
    Vec2 place_mm, normal;  ///< a point of the tangent; unit, outwards
    double sigma_mm = 0.0;  ///< of the place along the normal
  };
  void add_triangle(const TriangleMesh& mesh, std::uint32_t triangle);
  [[nodiscard]] std::optional<Flank> fit_flank(const std::vector<Seen>& seen, double side) const;

  EdgeFitOptions options_;
  std::vector<Sample> samples_;
  std::optional<PointGrid> grid_;
};

}  // namespace flytri::review
