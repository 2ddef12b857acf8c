#include "core/trajectory/path_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/median.h"
#include "core/base/random.h"
#include "core/geometry/decompositions.h"

namespace flytri::trajectory {

PathFit::PathFit(std::span<const TimedPose> poses, int degree) {
  assert(!poses.empty());
  const TimedPose& reference = poses[poses.size() / 2];
  T_world_reference_ = reference.T_world_sensor;
  reference_s_ = reference.time_s;
  double reach_s = 0.0;
  for (const TimedPose& pose : poses) {
    reach_s = std::max(reach_s, std::abs(pose.time_s - reference_s_));
  }
  if (reach_s > 0.0) scale_s_ = reach_s;
  const auto rows = static_cast<Eigen::Index>(poses.size());
  const Eigen::Index terms = std::min<Eigen::Index>(degree + 1, rows);
  Eigen::MatrixXd A(rows, terms), B(rows, 6);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const TimedPose& pose = poses[static_cast<std::size_t>(row)];
    const double t = (pose.time_s - reference_s_) / scale_s_;
    for (Eigen::Index i = 0; i < terms; ++i) A(row, i) = std::pow(t, static_cast<double>(i));
    B.row(row) = log_twist(T_world_reference_.inverse() * pose.T_world_sensor).transpose();
  }
  const Eigen::MatrixXd X = solve_each_regular(A, B);
  for (Eigen::Index i = 0; i < terms; ++i) coefficients_.emplace_back(X.row(i).transpose());
}

Isometry PathFit::at(double time_s) const {
  const double t = (time_s - reference_s_) / scale_s_;
  Twist twist = Twist::Zero();
  for (std::size_t i = coefficients_.size(); i-- > 0;) twist = twist * t + coefficients_[i];
  return T_world_reference_ * exp_twist(twist);
}

double pose_distance_mm(const Isometry& T_a_b, const Isometry& T_a_c, double arm_mm) {
  const Isometry T_b_c = T_a_b.inverse() * T_a_c;
  return std::hypot(arm_mm * rotation_angle(T_b_c), T_b_c.translation().norm());
}

double pose_chord_mm(const Isometry& T_a_b, const Isometry& T_a_c, double arm_mm) {
  const double turned = 0.5 * (T_a_b.linear() - T_a_c.linear()).squaredNorm();
  return std::sqrt((T_a_b.translation() - T_a_c.translation()).squaredNorm() +
                   arm_mm * arm_mm * turned);
}

namespace {

std::vector<double> deviations(std::span<const TimedPose> poses, const PathFit& curve,
                               double arm_mm) {
  std::vector<double> result;
  for (const TimedPose& pose : poses) {
    result.push_back(pose_distance_mm(pose.T_world_sensor, curve.at(pose.time_s), arm_mm));
  }
  return result;
}

/// A random subset of `count` poses in order of time.
std::vector<TimedPose> draw(std::span<const TimedPose> poses, std::size_t count, Random& random) {
  std::vector<TimedPose> subset;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::size_t needed = count - subset.size();
    if (needed > 0 && random.below(poses.size() - i) < needed) subset.push_back(poses[i]);
  }
  return subset;
}

}  // namespace

PathOutliers find_outliers(std::span<const TimedPose> poses, const OutlierOptions& options) {
  const auto minimal = static_cast<std::size_t>(options.degree) + 1;
  assert(poses.size() > minimal);
  Random random(options.seed);
  double best_median = 1e300;
  std::vector<double> best;
  for (int trial = 0; trial < options.trials; ++trial) {
    const PathFit curve(draw(poses, minimal, random), options.degree);
    std::vector<double> all = deviations(poses, curve, options.arm_mm);
    std::vector<double> ranked = all;
    const double median = median_of(ranked);
    if (median >= best_median) continue;
    best_median = median;
    best = std::move(all);
  }
  const double limit = std::max(options.min_deviation_mm, 5.0 * best_median / kMedianOfSigma);
  std::vector<TimedPose> inliers;
  std::vector<std::size_t> outliers;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    best[i] > limit ? outliers.push_back(i) : inliers.push_back(poses[i]);
  }
  return {PathFit(inliers, options.degree), std::move(outliers)};
}

}  // namespace flytri::trajectory
