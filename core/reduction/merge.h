/// @file  Averages the samples of one cell to one point with its uncertainty.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace flytri::reduction {

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

 private:
  [[nodiscard]] double compute(std::size_t count) const;

  double noise_length_samples_;
  std::vector<double> usual_;  ///< by count: asked for again and again
};

/// Merges samples of one surface, grouped by view: the noise of a view's samples is correlated,
/// that of different views is not. The uncertainty grows where the views disagree more than their
/// noise explains (Birge ratio).
/// @param members  indices into samples, at least one; those of a view in any order
[[nodiscard]] SurfacePoint merge_samples(std::span<const SurfaceSample> samples,
                                         std::span<const std::uint32_t> members,
                                         const MeanVariance& mean_variance);

}  // namespace flytri::reduction
