#include "core/trajectory/motion_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flytri::trajectory {
namespace {

constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kPosesUsed = 24;
/// With fewer poses around, a cubic through four is as good.
constexpr std::size_t kFewestPoses = 10;
constexpr std::size_t kTrials = 60;    ///< poses that are predicted from the others
constexpr double kTrustedShare = 0.9;  ///< of the trials: the others may be badly placed poses
constexpr int kTrendTerms = 4;         ///< the hand's slow motion: a cubic
/// A model is taken if it predicts at least this much better than the cubic through four poses.
constexpr double kLeastGain = 0.9;

std::vector<MotionModel::Kernel> possible_kernels() {
  std::vector<MotionModel::Kernel> kernels;
  for (const double noise : {1e-2, 1e-3, 1e-4, 1e-5}) {
    for (const double width_s : {0.04, 0.05, 0.06, 0.08, 0.12, 0.2}) {
      kernels.push_back({width_s, 0.0, noise});
    }
  }
  for (const double noise : {1e-2, 1e-3, 1e-4}) {
    for (const double width_s : {0.06, 0.08, 0.12, 0.2, 0.4}) {
      for (const double frequency_hz : {4.0, 6.0, 8.0, 10.0, 12.0}) {
        kernels.push_back({width_s, frequency_hz, noise});
      }
    }
  }
  return kernels;
}

/// Weights of the poses for the interpolation at a time.
Eigen::VectorXd weights_of(std::span<const TimedPose> poses, double time_s,
                           const MotionModel::Kernel& kernel) {
  const auto count = static_cast<Eigen::Index>(poses.size());
  const double scale_s = std::max(1e-3, 0.5 * (poses.back().time_s - poses.front().time_s));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count + kTrendTerms, count + kTrendTerms);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(count + kTrendTerms);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double at_s = poses[static_cast<std::size_t>(i)].time_s;
    for (Eigen::Index j = 0; j <= i; ++j) {
      A(i, j) = A(j, i) = kernel(at_s - poses[static_cast<std::size_t>(j)].time_s);
    }
    A(i, i) += kernel.noise;
    b[i] = kernel(at_s - time_s);
    double power = 1.0;
    for (Eigen::Index k = 0; k < kTrendTerms; ++k, power *= (at_s - time_s) / scale_s) {
      A(i, count + k) = A(count + k, i) = power;
    }
  }
  b[count] = 1.0;
  return A.partialPivLu().solve(b).head(count);
}

/// The twists of poses from a reference.
std::vector<Twist> twists_from(const Isometry& T_world_reference,
                               std::span<const TimedPose> poses) {
  const Isometry T_reference_world = T_world_reference.inverse();
  std::vector<Twist> twists;
  for (const TimedPose& pose : poses) {
    twists.push_back(log_twist(T_reference_world * pose.T_world_sensor));
  }
  return twists;
}

Twist weighted_sum(const Eigen::VectorXd& weights, std::span<const Twist> twists) {
  Twist sum = Twist::Zero();
  for (std::size_t i = 0; i < twists.size(); ++i) {
    sum += weights[static_cast<Eigen::Index>(i)] * twists[i];
  }
  return sum;
}

/// The poses on both sides of a time that a cubic takes: two and two.
std::vector<TimedPose> four_nearest(std::span<const TimedPose> poses, double time_s) {
  const auto after = std::find_if(poses.begin(), poses.end(),
                                  [&](const TimedPose& pose) { return pose.time_s >= time_s; });
  const auto first = after - std::min<std::ptrdiff_t>(2, after - poses.begin());
  const auto end = after + std::min<std::ptrdiff_t>(2, poses.end() - after);
  return {first, end};
}

/// A pose that is predicted from those around it.
struct Trial {
  double time_s = 0.0;
  std::vector<TimedPose> poses;
  std::vector<Twist> twists;  ///< of the poses, from the pose to predict
};

double size_mm(const Twist& twist, double arm_mm) {
  return std::hypot(twist.head<3>().norm() * arm_mm, twist.tail<3>().norm());
}

/// RMS of the best errors.
double trusted_rms(std::vector<double> errors_mm) {
  std::sort(errors_mm.begin(), errors_mm.end());
  const auto count = std::max<std::size_t>(
      1, static_cast<std::size_t>(kTrustedShare * static_cast<double>(errors_mm.size())));
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) squares += errors_mm[i] * errors_mm[i];
  return std::sqrt(squares / static_cast<double>(count));
}

double error_of(std::span<const Trial> trials, const MotionModel::Kernel& kernel, double arm_mm) {
  std::vector<double> errors_mm;
  for (const Trial& trial : trials) {
    const Eigen::VectorXd weights = weights_of(trial.poses, trial.time_s, kernel);
    errors_mm.push_back(size_mm(weighted_sum(weights, trial.twists), arm_mm));
  }
  return trusted_rms(errors_mm);
}

double error_of_cubic(std::span<const Trial> trials, double arm_mm) {
  std::vector<double> errors_mm;
  for (const Trial& trial : trials) {
    std::vector<TimedPose> relative = trial.poses;
    for (std::size_t i = 0; i < relative.size(); ++i) {
      relative[i].T_world_sensor = exp_twist(trial.twists[i]);
    }
    const Isometry found = PathFit(four_nearest(relative, trial.time_s), 3).at(trial.time_s);
    errors_mm.push_back(size_mm(log_twist(found), arm_mm));
  }
  return trusted_rms(errors_mm);
}

}  // namespace

double MotionModel::Kernel::operator()(double apart_s) const {
  const double share = apart_s / width_s;
  return std::exp(-0.5 * share * share) * std::cos(2.0 * std::numbers::pi * frequency_hz * apart_s);
}

MotionModel::MotionModel(std::span<const TimedPose> path, double arm_mm, double max_gap_s)
    : path_(path.begin(), path.end()), arm_mm_(arm_mm), max_gap_s_(max_gap_s) {
  std::stable_sort(path_.begin(), path_.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.time_s < b.time_s; });
  const auto end =
      std::unique(path_.begin(), path_.end(),
                  [](const TimedPose& a, const TimedPose& b) { return a.time_s == b.time_s; });
  path_.erase(end, path_.end());
  choose_kernel();
}

/// The nearest poses on both sides of a time, up to a gap. The pose `left_out` is not among them.
/// Empty if the time is not between two poses.
std::vector<TimedPose> MotionModel::around(double time_s, std::size_t left_out) const {
  const auto after = std::lower_bound(
      path_.begin(), path_.end(), time_s,
      [](const TimedPose& pose, double wanted_s) { return pose.time_s < wanted_s; });
  std::size_t first = static_cast<std::size_t>(after - path_.begin()), end = first;
  if (left_out != kNobody) ++end;
  if (first == 0 || end >= path_.size()) return {};
  if (path_[end].time_s - path_[first - 1].time_s > max_gap_s_) return {};
  const std::size_t hole = end - first;
  --first;
  ++end;
  while (end - first - hole < kPosesUsed) {
    const bool goes_back = first > 0 && path_[first].time_s - path_[first - 1].time_s <= max_gap_s_;
    const bool goes_on =
        end < path_.size() && path_[end].time_s - path_[end - 1].time_s <= max_gap_s_;
    if (!goes_back && !goes_on) break;
    const bool back_is_nearer =
        goes_back && goes_on && time_s - path_[first - 1].time_s < path_[end].time_s - time_s;
    if (goes_back && (!goes_on || back_is_nearer)) {
      --first;
    } else {
      ++end;
    }
  }
  std::vector<TimedPose> poses;
  for (std::size_t i = first; i < end; ++i) {
    if (i != left_out) poses.push_back(path_[i]);
  }
  return poses;
}

void MotionModel::choose_kernel() {
  std::vector<Trial> trials;
  const std::size_t step = std::max<std::size_t>(1, path_.size() / kTrials);
  for (std::size_t i = 2; i + 2 < path_.size(); i += step) {
    Trial trial{path_[i].time_s, around(path_[i].time_s, i), {}};
    if (trial.poses.size() < kFewestPoses) continue;
    trial.twists = twists_from(path_[i].T_world_sensor, trial.poses);
    trials.push_back(std::move(trial));
  }
  if (trials.size() < kFewestPoses) return;
  error_mm_ = error_of_cubic(trials, arm_mm_);
  double least_mm = kLeastGain * error_mm_;
  for (const Kernel& kernel : possible_kernels()) {
    const double error_mm = error_of(trials, kernel, arm_mm_);
    if (!(error_mm < least_mm)) continue;
    least_mm = error_mm_ = error_mm;
    kernel_ = kernel;
  }
}

std::optional<Isometry> MotionModel::interpolate(double time_s) const {
  const auto known = std::find_if(path_.begin(), path_.end(),
                                  [&](const TimedPose& pose) { return pose.time_s == time_s; });
  if (known != path_.end()) return known->T_world_sensor;
  const std::vector<TimedPose> poses = around(time_s, kNobody);
  if (poses.empty()) return std::nullopt;
  if (!kernel_ || poses.size() < kFewestPoses) {
    return PathFit(four_nearest(poses, time_s), 3).at(time_s);
  }
  const auto nearest =
      std::min_element(poses.begin(), poses.end(), [&](const TimedPose& a, const TimedPose& b) {
        return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
      });
  const std::vector<Twist> twists = twists_from(nearest->T_world_sensor, poses);
  return nearest->T_world_sensor *
         exp_twist(weighted_sum(weights_of(poses, time_s, *kernel_), twists));
}

}  // namespace flytri::trajectory
