/// @file  Interpolates the path of a trembling hand, as smoothly as the path itself shows it to be.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/trajectory/path_fit.h"

namespace flytri::trajectory {

/// A hand trembles at 8 to 12 Hz. At 30 poses a second, a curve through four poses misses this
/// motion by about 0.1 mm. This model uses 24 poses. It leaves out known poses one by one, and
/// takes the frequency and width of the trembling that predict them best.
/// @source  Rasmussen and Williams, "Gaussian Processes for Machine Learning", 2006: 2.7 (explicit
///          basis functions: a cubic in time), 4.2 (kernels), 5.3 (choice by leaving one out).
class MotionModel {
 public:
  /// @param path       in any order; of poses at the same time the first counts
  /// @param arm_mm     > 0, see Trajectory
  /// @param max_gap_s  > 0. Poses across a longer gap are not used together.
  MotionModel(std::span<const TimedPose> path, double arm_mm, double max_gap_s);

  /// Pose between known ones; nullopt before the first and after the last pose, and in gaps longer
  /// than max_gap_s.
  [[nodiscard]] std::optional<Isometry> interpolate(double time_s) const;

  /// How well poses are predicted from the others: RMS without the worst tenth; 0 if not known.
  [[nodiscard]] double error_mm() const { return error_mm_; }

  /// Covariance of the path at two times: exp(-(t / width)^2 / 2) cos(2 pi frequency t), and noise.
  struct Kernel {
    double width_s = 0.0;
    double frequency_hz = 0.0;
    double noise = 0.0;  ///< variance of a pose, as a share of that of the path
    [[nodiscard]] double operator()(double apart_s) const;
  };

 private:
  [[nodiscard]] std::vector<TimedPose> around(double time_s, std::size_t left_out) const;
  void choose_kernel();

  std::vector<TimedPose> path_;
  double arm_mm_;
  double max_gap_s_;
  std::optional<Kernel> kernel_;  ///< none: a cubic through the four nearest poses
  double error_mm_ = 0.0;
};

}  // namespace flytri::trajectory
