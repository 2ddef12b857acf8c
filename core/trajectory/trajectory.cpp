#include "core/trajectory/trajectory.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/base/median.h"

namespace flytri::trajectory {
namespace {

/// An extrapolation: a polynomial of `degree` through the last `window` poses.
struct Extrapolation {
  std::size_t window;
  int degree;
};
constexpr std::array kExtrapolations = {Extrapolation{1, 0}, Extrapolation{2, 1},
                                        Extrapolation{4, 1}, Extrapolation{6, 1},
                                        Extrapolation{6, 2}, Extrapolation{12, 1}};
constexpr std::size_t kLongestWindow = 12;
/// Longest gap, in time steps, that is extrapolated. After a longer gap the last pose is used with
/// a large uncertainty.
constexpr double kLongestGap = 30.0;
/// Number of latest poses for which the prediction is tested.
constexpr std::size_t kTestedPoses = 8;

Isometry extrapolate(std::span<const TimedPose> poses, const Extrapolation& by, double time_s) {
  const std::size_t count = std::min(by.window, poses.size());
  return PathFit(poses.last(count), by.degree).at(time_s);
}

/// RMS error of an extrapolation that predicts the last poses `gap` steps ahead.
double prediction_error_mm(std::span<const TimedPose> poses, const Extrapolation& by,
                           std::size_t gap, double arm_mm) {
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = poses.size(); i-- > gap && count < kTestedPoses; ++count) {
    const Isometry T_world_predicted = extrapolate(poses.first(i - gap + 1), by, poses[i].time_s);
    squares += std::pow(pose_distance_mm(T_world_predicted, poses[i].T_world_sensor, arm_mm), 2);
  }
  return std::sqrt(squares / std::max<double>(1.0, static_cast<double>(count)));
}

/// Median time between poses.
double usual_step(std::span<const TimedPose> poses) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    steps.push_back(poses[i].time_s - poses[i - 1].time_s);
  }
  return median_of(steps);
}

registration::PosePrior prior_of(double sigma_mm, double arm_mm) {
  // Half of the squared distance is rotation, half translation; each has three directions.
  return {sigma_mm / arm_mm / std::sqrt(6.0), sigma_mm / std::sqrt(6.0)};
}

}  // namespace

std::vector<TimedPose> Trajectory::before(double time_s, std::size_t count) const {
  std::vector<TimedPose> result;
  for (auto it = poses_.upper_bound(time_s); it != poses_.begin() && result.size() < count;) {
    --it;
    result.push_back({it->first, it->second});
  }
  std::reverse(result.begin(), result.end());
  return result;
}

std::vector<TimedPose> Trajectory::after(double time_s, std::size_t count) const {
  std::vector<TimedPose> result;
  for (auto it = poses_.upper_bound(time_s); it != poses_.end() && result.size() < count; ++it) {
    result.push_back({it->first, it->second});
  }
  return result;
}

std::vector<TimedPose> Trajectory::between(double from_s, double to_s) const {
  std::vector<TimedPose> result;
  for (auto it = poses_.lower_bound(from_s); it != poses_.end() && it->first <= to_s; ++it) {
    result.push_back({it->first, it->second});
  }
  return result;
}

std::optional<Isometry> Trajectory::interpolate(double time_s, double max_gap_s) const {
  const auto after = poses_.lower_bound(time_s);
  if (after == poses_.end()) return std::nullopt;
  if (after->first == time_s) return after->second;
  if (after == poses_.begin()) return std::nullopt;
  const auto prior = std::prev(after);
  if (after->first - prior->first > max_gap_s) return std::nullopt;
  // Ignore neighbors beyond a gap: they would distort the curve.
  std::vector<TimedPose> neighbors = {{prior->first, prior->second}, {after->first, after->second}};
  if (prior != poses_.begin()) {
    const auto first = std::prev(prior);
    if (prior->first - first->first <= max_gap_s) {
      neighbors.insert(neighbors.begin(), {first->first, first->second});
    }
  }
  const auto last = std::next(after);
  if (last != poses_.end() && last->first - after->first <= max_gap_s) {
    neighbors.push_back({last->first, last->second});
  }
  return PathFit(neighbors, 3).at(time_s);
}

PosePrediction Trajectory::predict(double time_s) const {
  assert(!poses_.empty());
  // Uncertainty while the motion is unknown, and the smallest stated uncertainty.
  const double unknown_mm = 0.15 * arm_mm_;
  const double least_mm = 0.02 * arm_mm_;
  const std::vector<TimedPose> poses =
      before(time_s, kTestedPoses + kLongestWindow + static_cast<std::size_t>(kLongestGap));
  PosePrediction rest = {poses.back().T_world_sensor, prior_of(unknown_mm, arm_mm_)};
  if (poses.size() < 4) return rest;
  const double steps = std::max(1.0, (time_s - poses.back().time_s) / usual_step(poses));
  const auto gap = static_cast<std::size_t>(std::lround(std::min(steps, kLongestGap)));
  // A longer gap needs more poses for a prediction.
  if (steps > kLongestGap || poses.size() < gap + 3) {
    return {rest.T_world_sensor, prior_of(4 * unknown_mm, arm_mm_)};
  }
  const Extrapolation* best = nullptr;
  double best_mm = 1e300;
  for (const Extrapolation& candidate : kExtrapolations) {
    const double error_mm = prediction_error_mm(poses, candidate, gap, arm_mm_);
    if (error_mm >= best_mm) continue;
    best_mm = error_mm;
    best = &candidate;
  }
  const double sigma_mm = std::max(least_mm * steps, 2.0 * best_mm);
  return {extrapolate(poses, *best, time_s), prior_of(std::min(sigma_mm, 4 * unknown_mm), arm_mm_)};
}

std::vector<Isometry> Trajectory::guesses(double time_s) const {
  const std::vector<TimedPose> poses = before(time_s, kExtrapolations.back().window);
  std::vector<Isometry> result;
  for (const Extrapolation& by : kExtrapolations) {
    if (by.window <= poses.size()) result.push_back(extrapolate(poses, by, time_s));
  }
  return result;
}

}  // namespace flytri::trajectory
