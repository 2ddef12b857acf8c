/// @file  A smooth curve through timed sensor poses, fitted in the presence of outliers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::trajectory {

/// Where the sensor was at a time.
struct TimedPose {
  double time_s = 0.0;
  Isometry T_world_sensor = Isometry::Identity();
};

/// A polynomial in time for rotation vector and translation, both relative to a reference pose, so
/// that short windows are far from the singularities of any chart of rotations.
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

/// Distance of two poses as the points of a view feel it: RMS over points at `arm_mm`.
[[nodiscard]] double pose_distance_mm(const Isometry& T_a_b, const Isometry& T_a_c, double arm_mm);
/// Nearly the same for small angles, without the angle itself: for thousands of poses.
[[nodiscard]] double pose_chord_mm(const Isometry& T_a_b, const Isometry& T_a_c, double arm_mm);

struct OutlierOptions {
  int degree = 2;   ///< 0..3, of the curve: over a few tenths of a second a hand is a parabola
  int trials = 40;  ///< >= 1, random subsets
  double min_deviation_mm = 0.2;  ///< > 0: below this a pose is never an outlier
  double arm_mm = 10.0;           ///< > 0, radius of the measurement volume
  std::uint64_t seed = 1;
};

/// What RANSAC found in a window of poses.
struct PathOutliers {
  PathFit curve;                      ///< least squares through the inliers
  std::vector<std::size_t> outliers;  ///< positions in the window, rising
};

/// Fits a curve to random minimal subsets, keeps the one with the least median deviation, and calls
/// outlier what deviates five times the robust spread: hands that tremble widen their own limit.
/// @param poses  more than degree + 1, at distinct times.
/// @source  Arold et al., "Sensor Movement Reconstruction"; Fischler and Bolles, 1981; the
///          threshold by the median: Rousseeuw, "Least median of squares regression", 1984.
[[nodiscard]] PathOutliers find_outliers(std::span<const TimedPose> poses,
                                         const OutlierOptions& options);

}  // namespace flytri::trajectory
