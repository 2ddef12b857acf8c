/// @file  The rigid motion that lays a result onto the true surface: takes the gauge out of errors.
#pragma once

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/mesh_distance.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::evaluation {

struct BestFitOptions {
  int sample_count = 20000;  ///< >= 6. Vertices that take part, evenly through the list: the motion
                             ///< has six unknowns, more of them would only cost time.
  int max_iterations = 50;   ///< >= 1. From within a few mm it takes about ten.
  double outlier_sigmas = 4.7;  ///< > 1. Tukey's cutoff in robust standard deviations: 95 %
                                ///< efficient where errors are normal.
  [[nodiscard]] Result<void> validate() const;
};

enum class BestFitOutcome {
  kConverged,
  kStillMoving,  ///< max_iterations were not enough; the motion is the last one
};

struct BestFit {
  Isometry T_truth_result = Isometry::Identity();
  BestFitOutcome outcome = BestFitOutcome::kStillMoving;
  int iterations = 0;
};

/// Iterates closest points and point-to-plane least squares with Tukey's weights, starting from
/// where the result lies. Directions that the surface leaves free (along a plane) stay as they are.
/// @source  Chen and Medioni, "Object Modelling by Registration of Multiple Range Images", 1992.
/// @errors  kBadOption; kInsufficient: one of the meshes is empty.
[[nodiscard]] Result<BestFit> best_fit(const TriangleMesh& result, const TriangleMesh& truth,
                                       const BestFitOptions& options, const Workers& workers);

}  // namespace flytri::evaluation
