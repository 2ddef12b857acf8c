/// @file  Averages the samples of one cell to one point with its uncertainty.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/point_cloud.h"
#include "core/reduction/sample_noise.h"

namespace flytri::reduction {

/// Merges samples of one surface, grouped by view: the noise of a view's samples is correlated,
/// that of different views is not. The uncertainty is increased where the views differ by more than
/// their noise (Birge ratio).
/// @param members  indices into samples, at least one, in any order
[[nodiscard]] SurfacePoint merge_samples(std::span<const SurfaceSample> samples,
                                         std::span<const std::uint32_t> members,
                                         const MeanVariance& mean_variance);

}  // namespace flytri::reduction
