/// @file  Averages the samples of one cell to one point with its uncertainty.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace flytri::reduction {

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

 private:
  [[nodiscard]] double compute(std::size_t count) const;

  double noise_length_samples_;
  std::vector<double> usual_;  ///< by count: cached, because small counts are frequent
};

/// Merges samples of one surface, grouped by view: the noise of a view's samples is correlated,
/// that of different views is not. The uncertainty is increased where the views differ by more than
/// their noise (Birge ratio).
/// @param members  indices into samples, at least one, in any order
[[nodiscard]] SurfacePoint merge_samples(std::span<const SurfaceSample> samples,
                                         std::span<const std::uint32_t> members,
                                         const MeanVariance& mean_variance);

}  // namespace flytri::reduction
