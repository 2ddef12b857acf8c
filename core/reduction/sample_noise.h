/// @file  The noise of samples, as the reduction and the live surface both model it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace flytri::reduction {

/// Samples over which the noise along a line is alike: speckle is, over 1.5 px.
inline constexpr double kNoiseLengthSamples = 1.5;

/// Standard uncertainty of a sample across a surface of the given normal, in mm.
///
/// A sample moves along its deviation, so the part of it along the normal counts. A tenth of the
/// rest is added: at grazing incidence the normal itself is not known better.
[[nodiscard]] float sigma_across_mm(const SurfaceSample& sample, const Vec3f& normal);

/// The square of that, from the deviation times its transpose; so it adds up over samples.
[[nodiscard]] float variance_across_mm2(const Eigen::Matrix3f& deviation2_mm2, const Vec3f& normal);

/// How far averaging over consecutive samples of a line helps. The noise of samples k apart is
/// taken to correlate as exp(-(k / noise_length_samples)^2).
class MeanVariance {
 public:
  /// @param noise_length_samples  > 0
  explicit MeanVariance(double noise_length_samples);

  /// Variance of the mean of `count` samples as a share of one sample's: 1 for noise that is the
  /// same along the line, 1 / count for white noise.
  [[nodiscard]] double share(std::size_t count) const {
    return count < usual_.size() ? usual_[count] : compute(count);
  }
  /// By how much sample number `count` of a line raises the variance of their sum, as a multiple of
  /// one sample's variance: 1 for white noise.
  [[nodiscard]] double added_to_sum(std::size_t count) const {
    const auto of_sum = [&](std::size_t n) {
      return static_cast<double>(n) * static_cast<double>(n) * share(n);
    };
    return of_sum(count) - of_sum(count - 1);
  }

 private:
  [[nodiscard]] double compute(std::size_t count) const;

  double noise_length_samples_;
  std::vector<double> usual_;  ///< by count: asked for again and again
};

}  // namespace flytri::reduction
