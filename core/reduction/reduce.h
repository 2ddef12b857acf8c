/// @file  Data reduction: merges many noisy samples into fewer averaged points.
///
/// @source  Arold et al., "Data Reduction" (cells elongated along the normal) and "Physical
///          Optimization" (lateral resolution of the lines, from which the cell width follows).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/point_cloud.h"
#include "core/reduction/sample_noise.h"

namespace flytri::reduction {

struct ReduceOptions {
  /// >= 0. Width of a cell across the normal. 0: three times the spacing of samples along a line,
  /// half the width of a projected line (4 to 9 camera pixels), so that two grooves at the
  /// resolution limit, two line widths apart, stay separate.
  double cell_mm = 0.0;
  /// > 0. Half length of a cell along the normal, in cell widths. Must cover the thickness of the
  /// point cloud, which noise and registration errors cause.
  double half_length_cells = 3.0;
  /// 0..90 degrees as rad, > 0. Samples whose normals differ by more belong to different surfaces.
  double max_normal_angle_rad = 1.05;
  /// > 0. A sample that differs by more than this many standard uncertainties from the other views
  /// is an outlier.
  double outlier_sigmas = 3.5;
  /// >= 1. Samples that must agree, including the sample itself. Otherwise the sample is dropped:
  /// it is a reflection or noise.
  int min_support = 5;
  /// > 0. Correlation length of the noise along a line, in samples. Averaging over correlated
  /// samples reduces the noise less.
  double noise_length_samples = kNoiseLengthSamples;

  [[nodiscard]] Result<void> validate() const;
};

/// Number of samples by result.
struct ReductionCounts {
  std::size_t sample_count = 0;
  std::size_t outlier_count = 0;   ///< dropped: other views disagree
  std::size_t isolated_count = 0;  ///< dropped: too few samples nearby
};

/// The reduced surface.
struct Reduction {
  PointCloud points;  ///< in spatial order; does not depend on the order of the samples
  double cell_mm = 0.0;
  ReductionCounts counts;
};

/// Merges the samples cell by cell. Position and normal are averages weighted by uncertainty; the
/// point's sigma_mm is the standard uncertainty of that average along the normal, from the
/// uncertainties of the samples and the differences between views. Samples that are not finite or
/// have no unit normal are dropped and count as isolated.
/// @param progress  advanced by one step
/// @errors  kBadOption; kInsufficient: no view has two samples, so their spacing is unknown;
///          kInconsistent: as divide_into_cells, or the uncertainties are far larger than the
///          spacing; kCancelled.
[[nodiscard]] Result<Reduction> reduce_samples(std::span<const SurfaceSample> samples,
                                               const ReduceOptions& options, const Workers& workers,
                                               const Progress& progress = {});

}  // namespace flytri::reduction
