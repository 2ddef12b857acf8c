#include "core/trajectory/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace flytri::trajectory {
namespace {

constexpr double kArm_mm = 10.0;

/// A motion that is cubic in time about one axis: a local cubic reproduces it exactly.
Isometry cubic_pose(double t) {
  Twist twist;
  const double angle = 0.3 * t - 0.2 * t * t + 0.1 * t * t * t;
  twist << Vec3(0.6, 0.8, 0) * angle, 4 * t, 1 - 3 * t * t, 2 * t * t * t;
  return exp_twist(twist);
}

Isometry swinging_pose(double t) {
  Twist twist;
  twist << 0.2 * std::sin(t), 0.1 * std::cos(1.3 * t), 0.3 * t, 5 * std::sin(0.8 * t), 3 * t, 1;
  return exp_twist(twist);
}

TEST(Trajectory, InterpolatesCubicMotionsExactlyAtUnevenTimes) {
  Trajectory trajectory(kArm_mm);
  for (const double t : {0.0, 0.1, 0.35, 0.4, 0.62, 0.7}) trajectory.set(t, cubic_pose(t));
  for (double t = 0.12; t < 0.6; t += 0.031) {
    const auto T = trajectory.interpolate(t, 0.5);
    ASSERT_TRUE(T);
    // Rotation and translation are relative to a rotated reference, so they are coupled: exact up
    // to terms of fourth order in the step.
    EXPECT_LT(pose_distance_mm(*T, cubic_pose(t), kArm_mm), 2e-3);
  }
  const auto at_knot = trajectory.interpolate(0.35, 0.5);
  ASSERT_TRUE(at_knot);
  EXPECT_LT(pose_distance_mm(*at_knot, cubic_pose(0.35), kArm_mm), 1e-12);
}

TEST(Trajectory, GivesNoPosesOutsideOrAcrossGaps) {
  Trajectory trajectory(kArm_mm);
  for (const double t : {0.0, 0.1, 0.2, 2.0, 2.1}) trajectory.set(t, swinging_pose(t));
  EXPECT_FALSE(trajectory.interpolate(-0.01, 0.5));
  EXPECT_FALSE(trajectory.interpolate(2.2, 0.5));
  EXPECT_FALSE(trajectory.interpolate(1.0, 0.5));
  EXPECT_TRUE(trajectory.interpolate(0.15, 0.5));
}

TEST(Trajectory, PredictsSmoothMotionByTimeNotByCount) {
  Trajectory trajectory(kArm_mm);
  for (int i = 0; i < 30; ++i) trajectory.set(i / 30.0, swinging_pose(i / 30.0));
  const PosePrediction next = trajectory.predict(1.0);
  const PosePrediction later = trajectory.predict(1.0 + 1.0 / 30.0);  // one frame was dropped
  EXPECT_LT(pose_distance_mm(next.T_world_sensor, swinging_pose(1.0), kArm_mm), 0.02);
  EXPECT_LT(pose_distance_mm(later.T_world_sensor, swinging_pose(1.0 + 1.0 / 30.0), kArm_mm), 0.05);
  EXPECT_GT(later.prior.translation_mm, next.prior.translation_mm);
}

TEST(Trajectory, StatedUncertaintyIncludesATremblingHand) {
  Random random(5);
  Trajectory trajectory(kArm_mm);
  int covered = 0, count = 0;
  for (int i = 0; i < 200; ++i) {
    Twist tremor;
    for (int k = 0; k < 6; ++k) tremor[k] = random.normal() * (k < 3 ? 0.003 : 0.05);
    const Isometry T = swinging_pose(i / 30.0) * exp_twist(tremor);
    if (i > 20) {
      const PosePrediction prediction = trajectory.predict(i / 30.0);
      const double error = (prediction.T_world_sensor.inverse() * T).translation().norm();
      covered += error < 3.0 * prediction.prior.translation_mm ? 1 : 0;
      ++count;
    }
    trajectory.set(i / 30.0, T);
  }
  EXPECT_GT(covered, 0.95 * count);
}

TEST(PathFit, RansacFindsExactlyTheInsertedOutliers) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    std::vector<TimedPose> poses;
    for (int i = 0; i < 14; ++i) {
      Twist noise;
      for (int k = 0; k < 6; ++k) noise[k] = random.normal() * (k < 3 ? 0.001 : 0.01);
      poses.push_back({i / 30.0, swinging_pose(i / 30.0) * exp_twist(noise)});
    }
    const std::vector<std::size_t> planted = {3, 7, 8};
    for (const std::size_t i : planted) {
      poses[i].T_world_sensor.translation() += Vec3(1.0 + 0.2 * i, -0.8, 0.4);
    }
    OutlierOptions options;
    options.seed = seed;
    const PathOutliers found = find_outliers(poses, options);
    EXPECT_EQ(found.outliers, planted);
    // The curve passes through the true poses of the outliers.
    for (const std::size_t i : planted) {
      const double t = poses[i].time_s;
      EXPECT_LT(pose_distance_mm(found.curve.at(t), swinging_pose(t), kArm_mm), 0.1);
    }
  }
}

}  // namespace
}  // namespace flytri::trajectory
