#include "core/trajectory/sensor_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flytri::trajectory {
namespace {

constexpr double kLongestGap_s = 0.15;

/// The pose of a sensor that moves in all directions.
Isometry pose_at(double time_s) {
  Twist twist;
  twist << 0.3 * std::sin(2.0 * time_s), 0.2 * std::cos(3.0 * time_s), 0.5 * time_s,
      10.0 * std::sin(1.5 * time_s), 8.0 * time_s, 3.0 * std::cos(2.5 * time_s);
  return exp_twist(twist);
}

/// The definition, by finite differences.
Twist true_velocity(double time_s) {
  constexpr double kStep_s = 1e-5;
  return log_twist(pose_at(time_s).inverse() * pose_at(time_s + kStep_s)) / kStep_s;
}

TEST(SensorVelocities, AreTheMotionInTheSensorsFrame) {
  std::vector<TimedPose> path;
  // One frame in ten is missing.
  for (int i = 0; i < 60; ++i)
    if (i % 10 != 7) path.push_back({i / 30.0, pose_at(i / 30.0)});
  const std::vector<Twist> velocities = sensor_velocities(path, kLongestGap_s);
  ASSERT_EQ(velocities.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Twist error = velocities[i] - true_velocity(path[i].time_s);
    const bool at_an_end = i < 2 || i + 2 >= path.size();
    EXPECT_LT(error.tail<3>().norm(), at_an_end ? 0.2 : 0.02) << i;
    EXPECT_LT(error.head<3>().norm(), at_an_end ? 0.02 : 0.002) << i;
  }
}

TEST(SensorVelocities, FollowATremblingHand) {
  std::vector<TimedPose> path;
  const double omega = 2.0 * std::numbers::pi * 5.0;
  for (int i = 0; i < 30; ++i) {
    Isometry T_world_sensor = Isometry::Identity();
    T_world_sensor.translation().x() = std::sin(omega * i / 30.0);
    path.push_back({i / 30.0, T_world_sensor});
  }
  const std::vector<Twist> velocities = sensor_velocities(path, kLongestGap_s);
  for (std::size_t i = 2; i + 2 < path.size(); ++i)
    EXPECT_NEAR(velocities[i][3], 0.965 * omega * std::cos(omega * path[i].time_s), 0.003 * omega);
}

TEST(SensorVelocities, DoNotReachAcrossAGap) {
  std::vector<TimedPose> path;
  for (const double time_s : {0.0, 1.0, 1.1, 5.0}) {
    Isometry T_world_sensor = Isometry::Identity();
    T_world_sensor.translation().y() = 3.0 * time_s + (time_s > 4.0 ? 100.0 : 0.0);
    path.push_back({time_s, T_world_sensor});
  }
  const std::vector<Twist> velocities = sensor_velocities(path, kLongestGap_s);
  EXPECT_EQ(velocities[0], Twist::Zero());
  EXPECT_NEAR(velocities[1][4], 3.0, 1e-9);
  EXPECT_NEAR(velocities[2][4], 3.0, 1e-9);
  EXPECT_EQ(velocities[3], Twist::Zero());
}

}  // namespace
}  // namespace flytri::trajectory
