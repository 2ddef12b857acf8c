/// @file  Smooths a line profile: removes noise and keeps the shape.
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/view.h"

namespace flytri {

/// Limits of the smoothing. The width of the Gaussian follows from noise and point spacing.
struct SmoothingOptions {
  /// Default 0.05, range (0, 1]. Largest standard uncertainty of the direction of a smoothed
  /// profile. It limits the accuracy of the normals at crossings.
  double max_direction_noise_rad = 0.05;
  /// Default 8, range [0.5, 100]. Widest Gaussian, in samples: a wider one would remove detail.
  double max_sigma_samples = 8.0;

  [[nodiscard]] Result<void> validate() const;
};

/// A point of a smoothed profile. Points are about one sigma apart.
struct SmoothedPoint {
  Vec3 position_mm;
  Vec3 direction;     ///< unit tangent in the direction of rising along_px, from a window twice as
                      ///< wide
  Vec3 deviation_mm;  ///< ProfilePoint::deviation_mm, reduced by the smoothing
  double along_px = 0;
};

/// Width of the Gaussian for this profile, in samples (neighboring points). The noise is taken from
/// the points' deviations, unless second differences show that it is larger or much smaller. Ideal
/// data gives 0.
[[nodiscard]] double smoothing_sigma(std::span<const ProfilePoint> points,
                                     const SmoothingOptions& options);

/// Smooths by local regression with Gaussian weights: linear at the ends, so they stay in place,
/// and quadratic inside, so curvature is kept. A plain Gaussian filter would shrink every cusp.
/// @param points  of one profile, at least 2.
/// @param sigma_samples  from smoothing_sigma(); below 0.4 the points stay as they are.
/// @source  Arold et al., "Single Registration" (Gaussian filter along each line profile);
///          local regression: Fan and Gijbels, "Local Polynomial Modelling", 1996.
[[nodiscard]] std::vector<SmoothedPoint> smooth_profile(std::span<const ProfilePoint> points,
                                                        double sigma_samples);

}  // namespace flytri
