#include "core/trajectory/sensor_velocity.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/decompositions.h"

namespace flytri::trajectory {
namespace {

/// Poses on each side of the one whose velocity is sought.
constexpr std::size_t kReach = 2;

/// Derivative at poses[middle] of a polynomial in time.
Twist velocity_at(std::span<const TimedPose> poses, std::size_t middle) {
  const std::size_t after = poses.size() - 1 - middle;
  const std::size_t degree =
      std::min(middle, after) >= kReach ? 3 : std::min<std::size_t>(2, poses.size() - 1);
  if (degree == 0) return Twist::Zero();
  const auto rows = static_cast<Eigen::Index>(poses.size());
  const auto terms = static_cast<Eigen::Index>(degree) + 1;
  const TimedPose& reference = poses[middle];
  const double scale_s = poses.back().time_s - poses.front().time_s;
  const Isometry T_reference_world = reference.T_world_sensor.inverse();
  Eigen::MatrixXd A(rows, terms), B(rows, 6);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const TimedPose& pose = poses[static_cast<std::size_t>(row)];
    const double t = (pose.time_s - reference.time_s) / scale_s;
    for (Eigen::Index i = 0; i < terms; ++i) A(row, i) = std::pow(t, static_cast<double>(i));
    B.row(row) = log_twist(T_reference_world * pose.T_world_sensor).transpose();
  }
  return solve_each_regular(A, B).row(1).transpose() / scale_s;
}

}  // namespace

Twist sensor_velocity(std::span<const TimedPose> path, std::size_t i, double max_gap_s) {
  std::size_t first = i, last = i;
  while (i - first < kReach && first > 0 &&
         path[first].time_s - path[first - 1].time_s <= max_gap_s)
    --first;
  while (last - i < kReach && last + 1 < path.size() &&
         path[last + 1].time_s - path[last].time_s <= max_gap_s)
    ++last;
  return velocity_at(path.subspan(first, last - first + 1), i - first);
}

std::vector<Twist> sensor_velocities(std::span<const TimedPose> path, double max_gap_s) {
  std::vector<Twist> velocities;
  for (std::size_t i = 0; i < path.size(); ++i)
    velocities.push_back(sensor_velocity(path, i, max_gap_s));
  return velocities;
}

}  // namespace flytri::trajectory
