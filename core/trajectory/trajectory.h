/// @file  The path of the sensor during a scan, and the prediction of its next pose.
#pragma once

#include <map>
#include <optional>

#include "core/registration/pose_solver.h"
#include "core/trajectory/path_fit.h"

namespace flytri::trajectory {

/// A predicted pose and its expected error.
struct PosePrediction {
  Isometry T_world_sensor = Isometry::Identity();
  registration::PosePrior prior;
};

/// Poses by time. The real time is used, so that dropped frames leave gaps.
class Trajectory {
 public:
  /// @param arm_mm  > 0, radius of the surface that the sensor sees: converts rotation to distance.
  explicit Trajectory(double arm_mm) : arm_mm_(arm_mm) {}

  /// Adds a pose or replaces that of the same time.
  void set(double time_s, const Isometry& T_world_sensor) { poses_[time_s] = T_world_sensor; }
  void erase(double time_s) { poses_.erase(time_s); }
  [[nodiscard]] bool empty() const { return poses_.empty(); }
  [[nodiscard]] std::size_t size() const { return poses_.size(); }
  [[nodiscard]] double last_time_s() const { return poses_.rbegin()->first; }

  /// Up to `count` poses with times up to and including time_s, by rising time.
  [[nodiscard]] std::vector<TimedPose> before(double time_s, std::size_t count) const;
  /// Up to `count` poses with times after time_s, by rising time.
  [[nodiscard]] std::vector<TimedPose> after(double time_s, std::size_t count) const;
  /// All poses with times in [from_s, to_s].
  [[nodiscard]] std::vector<TimedPose> between(double from_s, double to_s) const;

  /// Pose between known ones: a cubic in time through the four nearest poses, exact if the motion
  /// is a cubic. nullopt before the first and after the last pose, and in gaps longer than
  /// max_gap_s.
  [[nodiscard]] std::optional<Isometry> interpolate(double time_s, double max_gap_s) const;

  /// Predicts a pose after the last known one. Takes the extrapolation (at rest, linear or
  /// quadratic) that predicts the latest poses best over the same time; its errors there give the
  /// uncertainty. The trajectory must not be empty.
  [[nodiscard]] PosePrediction predict(double time_s) const;
  /// Other possible poses at time_s: at rest since the last pose before, or extrapolated from the
  /// latest poses in several ways. Empty if there is no pose before.
  [[nodiscard]] std::vector<Isometry> guesses(double time_s) const;

 private:
  double arm_mm_;
  std::map<double, Isometry> poses_;
};

}  // namespace flytri::trajectory
