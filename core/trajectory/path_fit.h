/// @file  Fits a smooth curve to timed sensor poses and finds outliers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::trajectory {

/// Pose of the sensor at a time.
struct TimedPose {
  double time_s = 0.0;
  Isometry T_world_sensor = Isometry::Identity();
};

/// A polynomial in time for rotation vector and translation, both relative to a reference pose, so
/// that rotations in a short window are small and far from singularities.
/// @source  Arold et al., "Sensor Movement Reconstruction"; rotations: Horn, 1987.
class PathFit {
 public:
  /// Least squares through the poses; the degree is lowered if there are too few of them.
  /// @param poses  at least 1, at distinct times.
  PathFit(std::span<const TimedPose> poses, int degree);

  [[nodiscard]] Isometry at(double time_s) const;

 private:
  Isometry T_world_reference_;
  double reference_s_ = 0.0;
  double scale_s_ = 1.0;
  std::vector<Twist> coefficients_;  ///< of ((t - reference) / scale)^i
};

/// Distance of two poses in mm: root sum of squares of the translation and the rotation angle times
/// `arm_mm`.
[[nodiscard]] double pose_distance_mm(const Isometry& T_a_b, const Isometry& T_a_c, double arm_mm);
/// Approximation of pose_distance_mm() for small angles. Faster: computes no angle.
[[nodiscard]] double pose_chord_mm(const Isometry& T_a_b, const Isometry& T_a_c, double arm_mm);

struct OutlierOptions {
  int degree = 2;   ///< 0..3, of the curve: a parabola describes the hand over a few tenths of a
                    ///< second
  int trials = 40;  ///< >= 1, random subsets
  double min_deviation_mm = 0.2;  ///< > 0: below this a pose is never an outlier
  double arm_mm = 10.0;           ///< > 0, radius of the measurement volume
  std::uint64_t seed = 1;
};

/// Result of RANSAC in a window of poses.
struct PathOutliers {
  PathFit curve;                      ///< least squares through the inliers
  std::vector<std::size_t> outliers;  ///< positions in the window, rising
};

/// Fits a curve to random minimal subsets and keeps the one with the least median deviation. Poses
/// that deviate by more than five times the robust spread are outliers: a trembling hand gets a
/// larger limit.
/// @param poses  more than degree + 1, at distinct times.
/// @source  Arold et al., "Sensor Movement Reconstruction"; Fischler and Bolles, 1981; the
///          threshold by the median: Rousseeuw, "Least median of squares regression", 1984.
[[nodiscard]] PathOutliers find_outliers(std::span<const TimedPose> poses,
                                         const OutlierOptions& options);

}  // namespace flytri::trajectory
