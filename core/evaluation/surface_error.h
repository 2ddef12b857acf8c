/// @file  Accuracy and completeness of a result, compared with the true surface.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"

namespace flytri::evaluation {

/// Statistics of unsigned distances, mm. All 0 if there are none.
struct DistanceStatistics {
  std::int64_t count = 0;
  double rms_mm = 0.0;
  double mean_mm = 0.0;
  double median_mm = 0.0;
  double percentile_95_mm = 0.0;
  double max_mm = 0.0;
};

/// @param distances_mm  all finite
[[nodiscard]] DistanceStatistics distance_statistics(std::vector<double> distances_mm);

/// Share of the true surface that a result covers, by two criteria.
struct Completeness {
  std::int64_t selected = 0;  ///< number of selected true vertices
  double near_surface = 0.0;  ///< share with the result's surface within complete_within_mm, 0..1
  double near_vertex = 0.0;   ///< share with one of the result's vertices within it, 0..1
};

struct SurfaceErrorOptions {
  double complete_within_mm = 0.1;  ///< > 0. Half the layer spacing of a printed dental model.
  double far_above_mm = 0.1;  ///< > 0. A vertex farther away does not belong to the surface of a
                              ///< dental model.
  [[nodiscard]] Result<void> validate() const;
};

struct SurfaceError {
  DistanceStatistics distance;  ///< from every vertex of the result to the true surface
  double far_share = 0.0;       ///< share of those above far_above_mm, 0..1
  Completeness completeness;
};

/// Which vertices lie where lines of both patterns were: a measured point of each is near.
/// @param views      at their true poses
/// @param within_mm  > 0
[[nodiscard]] std::vector<bool> crossed_vertices(const TriangleMesh& truth,
                                                 const std::vector<AlignedView>& views,
                                                 double within_mm, const Workers& workers);

/// How much of the true surface a result covers.
/// @param selected   parallel to truth.vertices: which of them count; empty: all
/// @param within_mm  > 0
[[nodiscard]] Completeness completeness(const TriangleMesh& result, const TriangleMesh& truth,
                                        const std::vector<bool>& selected, double within_mm,
                                        const Workers& workers);

/// Compares two meshes that lie in the same frame.
/// @param result    all its vertices count, including outliers
/// @param selected  parallel to truth.vertices: which of them could be measured; empty: all
/// @errors  kBadOption; kInsufficient: one of the meshes is empty; kInconsistent: length of
///          `selected`.
[[nodiscard]] Result<SurfaceError> surface_error(const TriangleMesh& result,
                                                 const TriangleMesh& truth,
                                                 const std::vector<bool>& selected,
                                                 const SurfaceErrorOptions& options,
                                                 const Workers& workers);

/// The mesh moved rigidly: positions and normals.
[[nodiscard]] TriangleMesh transformed(const TriangleMesh& mesh, const Isometry& T_to_from);

}  // namespace flytri::evaluation
