#include "core/trajectory/motion_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/trajectory/trajectory.h"

namespace flytri::trajectory {
namespace {

constexpr double kReach_mm = 15.0;
constexpr double kGap_s = 0.5;

/// A slow sweep of the hand, with a trembling of some frequencies that never repeats.
Isometry trembling_pose(double t, double tremor_mm) {
  const auto wave = [t](double hz, double phase) {
    return std::sin(2.0 * std::numbers::pi * hz * t + phase);
  };
  Twist twist;
  twist << 0.2 * std::sin(t) + tremor_mm / kReach_mm * wave(9.1, 0.3),
      0.1 * std::cos(1.3 * t) + tremor_mm / kReach_mm * wave(10.7, 1.0), 0.3 * t,
      5 * std::sin(0.8 * t) + tremor_mm * (wave(8.3, 0.0) + wave(11.2, 2.0)),
      3 * t + tremor_mm * wave(9.7, 1.7), tremor_mm * wave(10.1, 0.6);
  return exp_twist(twist);
}

/// Poses at 30 Hz; each thirtieth is missing, as there is a texture frame.
std::vector<TimedPose> path_without_texture_frames(double tremor_mm, double noise_mm = 0.0) {
  Random random(5);
  std::vector<TimedPose> path;
  for (int i = 0; i < 200; ++i) {
    if (i % 30 == 15) continue;
    Twist noise;
    for (int k = 0; k < 6; ++k) noise[k] = noise_mm * random.normal() / (k < 3 ? kReach_mm : 1.0);
    path.push_back({i / 30.0, trembling_pose(i / 30.0, tremor_mm) * exp_twist(noise)});
  }
  return path;
}

double rms_of_missing(const MotionModel& model, double tremor_mm) {
  double squares = 0.0;
  for (int i = 15; i < 200; i += 30) {
    const auto found = model.interpolate(i / 30.0);
    if (!found) return 1e9;
    squares +=
        std::pow(pose_distance_mm(*found, trembling_pose(i / 30.0, tremor_mm), kReach_mm), 2);
  }
  return std::sqrt(squares / 7.0);
}

TEST(MotionModel, FindsAPoseBetweenThoseOfATremblingHand) {
  constexpr double kTremor_mm = 0.06;
  const std::vector<TimedPose> path = path_without_texture_frames(kTremor_mm, 0.002);
  Trajectory cubic(kReach_mm);
  for (const TimedPose& pose : path) cubic.set(pose.time_s, pose.T_world_sensor);
  double squares = 0.0;
  for (int i = 15; i < 200; i += 30) {
    squares += std::pow(pose_distance_mm(*cubic.interpolate(i / 30.0, kGap_s),
                                         trembling_pose(i / 30.0, kTremor_mm), kReach_mm),
                        2);
  }
  EXPECT_GT(std::sqrt(squares / 7.0), 0.08);
  EXPECT_LT(rms_of_missing(MotionModel(path, kReach_mm, kGap_s), kTremor_mm), 0.025);
}

TEST(MotionModel, ASteadyHandIsFollowedAsWell) {
  const std::vector<TimedPose> path = path_without_texture_frames(0.0);
  EXPECT_LT(rms_of_missing(MotionModel(path, kReach_mm, kGap_s), 0.0), 1e-3);
}

TEST(MotionModel, TellsHowWellItPredicts) {
  const MotionModel model(path_without_texture_frames(0.06, 0.002), kReach_mm, kGap_s);
  EXPECT_GT(model.error_mm(), 0.001);
  EXPECT_LT(model.error_mm(), 0.06);
}

TEST(MotionModel, FewPosesGiveACubic) {
  std::vector<TimedPose> path;
  for (int i = 0; i < 5; ++i) path.push_back({i / 30.0, trembling_pose(i / 30.0, 0.0)});
  const MotionModel model(path, kReach_mm, kGap_s);
  const auto found = model.interpolate(1.5 / 30.0);
  ASSERT_TRUE(found);
  EXPECT_LT(pose_distance_mm(*found, trembling_pose(1.5 / 30.0, 0.0), kReach_mm), 1e-3);
  EXPECT_EQ(model.error_mm(), 0.0);
}

TEST(MotionModel, GivesNoPosesOutsideOrAcrossGaps) {
  std::vector<TimedPose> path;
  for (const double t : {0.0, 0.1, 0.2, 2.0, 2.1}) path.push_back({t, trembling_pose(t, 0.0)});
  const MotionModel model(path, kReach_mm, kGap_s);
  EXPECT_FALSE(model.interpolate(-0.01));
  EXPECT_FALSE(model.interpolate(2.2));
  EXPECT_FALSE(model.interpolate(1.0));
  EXPECT_TRUE(model.interpolate(0.15));
  EXPECT_FALSE(MotionModel({}, kReach_mm, kGap_s).interpolate(0.0));
}

TEST(MotionModel, APoseThatIsKnownIsGivenAsItIs) {
  const std::vector<TimedPose> path = path_without_texture_frames(0.06);
  const MotionModel model(path, kReach_mm, kGap_s);
  EXPECT_EQ(model.interpolate(path[7].time_s)->matrix(), path[7].T_world_sensor.matrix());
}

TEST(MotionModel, TheOrderOfThePosesDoesNotMatter) {
  std::vector<TimedPose> path = path_without_texture_frames(0.2);
  const MotionModel model(path, kReach_mm, kGap_s);
  path.push_back(path[7]);
  std::reverse(path.begin(), path.end());
  const MotionModel same(path, kReach_mm, kGap_s);
  const Isometry expected = model.interpolate(2.51).value(), found = same.interpolate(2.51).value();
  EXPECT_TRUE(found.isApprox(expected, 0.0));
}

}  // namespace
}  // namespace flytri::trajectory
