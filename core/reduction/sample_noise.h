/// @file  Noise model of samples, used by the data reduction and the live surface.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace flytri::reduction {

/// Correlation length of the noise along a line, in samples (speckle: 1.5 px).
inline constexpr double kNoiseLengthSamples = 1.5;

/// Standard uncertainty of a sample across a surface of the given normal, in mm.
///
/// Noise moves a sample along its deviation, so its part along the normal counts. A tenth of the
/// deviation is added, because at grazing incidence the normal is inaccurate.
[[nodiscard]] float sigma_across_mm(const SurfaceSample& sample, const Vec3f& normal);

/// The square of sigma_across_mm, from the deviation times its transpose, so that it can be summed
/// over samples.
[[nodiscard]] float variance_across_mm2(const Eigen::Matrix3f& deviation2_mm2, const Vec3f& normal);

/// How much averaging over consecutive samples of a line reduces the variance. The noise of samples
/// at distance k is assumed to correlate as exp(-(k / noise_length_samples)^2).
class MeanVariance {
 public:
  /// @param noise_length_samples  > 0
  explicit MeanVariance(double noise_length_samples);

  /// Variance of the mean of `count` samples divided by the variance of one sample: 1 for fully
  /// correlated noise, 1 / count for white noise.
  [[nodiscard]] double share(std::size_t count) const {
    return count < usual_.size() ? usual_[count] : compute(count);
  }
  /// Increase of the variance of the sum by sample number `count` of a line, divided by the
  /// variance of one sample: 1 for white noise.
  [[nodiscard]] double added_to_sum(std::size_t count) const {
    const auto of_sum = [&](std::size_t n) {
      return static_cast<double>(n) * static_cast<double>(n) * share(n);
    };
    return of_sum(count) - of_sum(count - 1);
  }

 private:
  [[nodiscard]] double compute(std::size_t count) const;

  double noise_length_samples_;
  std::vector<double> usual_;  ///< by count: cached, because small counts are frequent
};

}  // namespace flytri::reduction
