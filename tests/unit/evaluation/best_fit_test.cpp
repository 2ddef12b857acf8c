#include "core/evaluation/best_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/evaluation/surface_error.h"
#include "tests/support/sample_meshes.h"

namespace flytri::evaluation {
namespace {

TriangleMesh waves() {
  return height_field({.half_width_mm = 8.0, .step_mm = 0.25},
                      [](double x, double y) { return std::sin(0.9 * x) * std::cos(0.7 * y); });
}

Isometry small_motion() {
  Twist twist;
  twist << 0.01, -0.015, 0.02, 0.1, -0.15, 0.05;
  return exp_twist(twist);
}

TEST(BestFit, RecoversAMotionInBothDirections) {
  for (const Isometry& T : {small_motion(), Isometry(small_motion().inverse())}) {
    const TriangleMesh result = transformed(waves(), T);
    const BestFit fit = best_fit(result, waves(), {}, Workers(1)).value();
    EXPECT_EQ(fit.outcome, BestFitOutcome::kConverged);
    // Positions are floats: at 8 mm their resolution is half a nanometer, that of a sum little
    // more.
    const Twist rest = log_twist(fit.T_truth_result * T);
    EXPECT_LT(rest.head<3>().norm(), 1e-6);
    EXPECT_LT(rest.tail<3>().norm(), 1e-5);
  }
}

TEST(BestFit, OutliersDoNotAffectTheFit) {
  TriangleMesh result = transformed(waves(), small_motion());
  Random random(11);
  for (SurfacePoint& vertex : result.vertices) {
    const double far_mm = random.uniform() < 0.05 ? 1.5 : 0.01 * random.normal();
    vertex.position_mm.z() += static_cast<float>(far_mm);
  }
  const BestFit fit = best_fit(result, waves(), {}, Workers(1)).value();
  // 0.01 mm of noise over 4000 vertices leaves an error well below 1 µm. The outliers would cause
  // 75 µm if they were not suppressed.
  const Twist rest = log_twist(fit.T_truth_result * small_motion());
  EXPECT_LT(rest.tail<3>().norm(), 2e-3);
}

TEST(BestFit, UndeterminedDirectionsDoNotChange) {
  const TriangleMesh plane =
      height_field({.half_width_mm = 5.0, .step_mm = 0.5}, [](double, double) { return 0.0; });
  Isometry T = Isometry::Identity();
  T.translation() = Vec3(0.0, 0.0, 0.2);
  const BestFit fit = best_fit(transformed(plane, T), plane, {}, Workers(1)).value();
  EXPECT_NEAR((fit.T_truth_result.translation() - Vec3(0.0, 0.0, -0.2)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(rotation_angle(fit.T_truth_result), 0.0, 1e-6);
}

TEST(BestFit, OneThreadAndManyGiveTheSameBits) {
  const TriangleMesh result = transformed(waves(), small_motion());
  const BestFit one = best_fit(result, waves(), {}, Workers(1)).value();
  const BestFit many = best_fit(result, waves(), {}, Workers(4)).value();
  EXPECT_EQ(one.T_truth_result.matrix(), many.T_truth_result.matrix());
  EXPECT_EQ(one.iterations, many.iterations);
}

TEST(BestFit, RejectsEmptyMeshesAndBadOptions) {
  EXPECT_EQ(best_fit({}, waves(), {}, Workers(1)).error().code, ErrorCode::kInsufficient);
  EXPECT_EQ(best_fit(waves(), {}, {}, Workers(1)).error().code, ErrorCode::kInsufficient);
  EXPECT_EQ(best_fit(waves(), waves(), {.max_iterations = 0}, Workers(1)).error().code,
            ErrorCode::kBadOption);
}

}  // namespace
}  // namespace flytri::evaluation
