#include "core/refinement/rolling_shutter.h"

#include <gtest/gtest.h>

#include "core/refinement/refine.h"
#include "tests/support/moved_light.h"
#include "tests/support/rolled_views.h"
#include "tests/support/scan_scene.h"

namespace flytri::refinement {
namespace {

using testing::camera_rows;
using testing::displacement_rms_mm;
using testing::rolled;
using testing::scan_cusps;
using testing::SceneSensor;

/// A hand of about 9 mm/s.
std::vector<AlignedView> true_scan(std::uint64_t seed) {
  return scan_cusps(80, SceneSensor{}, seed, 0.3).views;
}

TEST(SeenLate, DerivativeIsThatOfThePosition) {
  Twist velocity;
  velocity << 0.4, -0.7, 0.2, 12.0, -9.0, 5.0;
  const Vec3 p_mm(4.0, -6.0, 3.0);
  constexpr double kLate_s = 0.01, kStep_s = 1e-5;
  const Vec3 difference = (trajectory::seen_late(velocity, kLate_s + kStep_s, p_mm) -
                           trajectory::seen_late(velocity, kLate_s - kStep_s, p_mm)) /
                          (2.0 * kStep_s);
  const Vec3 derivative = trajectory::seen_late_derivative(
      velocity, kLate_s, trajectory::seen_late(velocity, kLate_s, p_mm));
  EXPECT_LT((difference - derivative).norm(), 1e-6);
  EXPECT_GT(derivative.norm(), 10.0);
}

TEST(WithoutRollingShutter, PutsThePointsWhereTheyWere) {
  const auto truth = true_scan(1);
  const auto seen = rolled(truth, 0.015);
  EXPECT_GT(displacement_rms_mm(seen, truth), 0.02);
  EXPECT_LT(displacement_rms_mm(without_rolling_shutter(seen, 0.015, camera_rows()), truth), 1e-6);
}

class EstimateReadout : public ::testing::TestWithParam<double> {};

TEST_P(EstimateReadout, ReadoutIsFound) {
  const auto truth = true_scan(2);
  auto without = testing::with_drift(rolled(truth, GetParam()), 0.1, 3);
  ASSERT_TRUE(refine_jointly(without, {}, Workers(2), {}));
  auto readout = estimate_readout(without, camera_rows(), {}, Workers(2), {});
  ASSERT_TRUE(readout);
  EXPECT_TRUE(readout->is_long());
  EXPECT_NEAR(readout->readout_s, GetParam(), 0.2 * std::abs(GetParam()));
  auto with = without;
  ASSERT_TRUE(refine_with_readout(with, *readout, camera_rows(), {}, Workers(2), {}));
  EXPECT_NEAR(readout->readout_s, GetParam(), 3e-4);
  EXPECT_LT(readout->uncertainty_s, 2e-4);
  EXPECT_LT(displacement_rms_mm(with, truth), 0.5 * displacement_rms_mm(without, truth));
  EXPECT_LT(displacement_rms_mm(with, truth), 0.015);
}

/// Also with the last row first.
INSTANTIATE_TEST_SUITE_P(Readouts, EstimateReadout, ::testing::Values(-0.02, 0.008, 0.015, 0.03));

TEST(RefineWithReadout, FindsItFromAFarStart) {
  const auto truth = scan_cusps(80, SceneSensor{}, 8, 1.0).views;
  auto unaware = testing::with_drift(rolled(truth, 0.02), 0.1, 3);
  ASSERT_TRUE(refine_jointly(unaware, {}, Workers(2), {}));
  for (const double start_s : {0.004, 0.012, 0.03}) {
    auto views = unaware;
    Readout readout{start_s, 0.0};
    ASSERT_TRUE(refine_with_readout(views, readout, camera_rows(), {}, Workers(2), {}));
    EXPECT_NEAR(readout.readout_s, 0.02, 5e-4) << "from " << start_s;
  }
}

TEST(EstimateReadout, GlobalShutterHasNoReadout) {
  for (const std::uint64_t seed : {4, 5}) {
    auto views = testing::with_drift(true_scan(seed), 0.1, seed);
    ASSERT_TRUE(refine_jointly(views, {}, Workers(2), {}));
    const auto readout = estimate_readout(views, camera_rows(), {}, Workers(2), {});
    ASSERT_TRUE(readout);
    EXPECT_LT(std::abs(readout->readout_s), 5e-4);
    EXPECT_FALSE(readout->is_long());
  }
}

TEST(EstimateReadout, SensorAtRestTellsNoReadout) {
  const auto views = scan_cusps(20, SceneSensor{}, 6, 0.0).views;
  const auto readout = estimate_readout(views, camera_rows(), {}, Workers(2), {});
  ASSERT_TRUE(readout);
  EXPECT_FALSE(readout->is_long());
}

TEST(EstimateReadout, RefusesNoViewsAndStopsWhenCanceled) {
  const auto none = estimate_readout({}, camera_rows(), {}, Workers(2), {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kInsufficient);
  const Progress progress;
  progress.cancel();
  const auto truth = scan_cusps(10, SceneSensor{}, 7).views;
  auto views = rolled(truth, 0.015);
  const auto before = views;
  Readout readout{0.01, 0.0};
  const auto stopped = refine_with_readout(views, readout, camera_rows(), {}, Workers(2), progress);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(readout.readout_s, 0.01);
  for (std::size_t v = 0; v < views.size(); ++v) EXPECT_EQ(views[v].view, before[v].view);
}

}  // namespace
}  // namespace flytri::refinement
