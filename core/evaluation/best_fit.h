/// @file  Finds the rigid motion that fits a result to the true surface, so that errors do not
///          depend on the frame.
#pragma once

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/mesh_distance.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::evaluation {

struct BestFitOptions {
  int sample_count = 20000;     ///< >= 6. Number of vertices used, evenly spaced in the list. The
                                ///< motion has six unknowns, so more would only take time.
  int max_iterations = 50;      ///< >= 1. About ten are enough from a start within a few mm.
  double outlier_sigmas = 4.7;  ///< > 1. Tukey's cutoff in robust standard deviations: 95 %
                                ///< efficient for normally distributed errors.
  [[nodiscard]] Result<void> validate() const;
};

enum class BestFitOutcome {
  kConverged,
  kStillMoving,  ///< max_iterations reached; the motion is that of the last iteration
};

struct BestFit {
  Isometry T_truth_result = Isometry::Identity();
  BestFitOutcome outcome = BestFitOutcome::kStillMoving;
  int iterations = 0;
};

/// Iterates closest points and point-to-plane least squares with Tukey's weights, starting at the
/// present pose. Directions that the surface does not determine (along a plane) are not changed.
/// @source  Chen and Medioni, "Object Modelling by Registration of Multiple Range Images", 1992.
/// @errors  kBadOption; kInsufficient: one of the meshes is empty.
[[nodiscard]] Result<BestFit> best_fit(const TriangleMesh& result, const TriangleMesh& truth,
                                       const BestFitOptions& options, const Workers& workers);

}  // namespace flytri::evaluation
