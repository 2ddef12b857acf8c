/// @file  Gaussian smoothing along a line profile that removes noise and leaves the shape.
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/view.h"

namespace flytri {

/// How strongly profiles are smoothed. No length is fixed: it follows from noise and spacing.
struct SmoothingOptions {
  /// Default 0.05, range (0, 1]. Standard uncertainty that the direction of a smoothed profile may
  /// keep: it limits how well a crossing's normal is known.
  double max_direction_noise_rad = 0.05;
  /// Default 8, range [0.5, 100]. Widest Gaussian, in samples: beyond it detail is lost.
  double max_sigma_samples = 8.0;

  [[nodiscard]] Result<void> validate() const;
};

/// A profile after smoothing, thinned to points that are about one sigma apart.
struct SmoothedPoint {
  Vec3 position_mm;
  Vec3 direction;     ///< unit tangent by rising along_px, from a window twice as wide
  Vec3 deviation_mm;  ///< ProfilePoint::deviation_mm, reduced by the smoothing
  double along_px = 0;
};

/// Width of the Gaussian for this profile, in samples (neighboring points). Noise is what the
/// points state, unless their second differences show that it is more or far less; ideal data
/// gives 0.
[[nodiscard]] double smoothing_sigma(std::span<const ProfilePoint> points,
                                     const SmoothingOptions& options);

/// Smooths by local regression with Gaussian weights, which keeps ends in place, and of second
/// order inside, which keeps curvature: a plain Gaussian would pull every cusp inwards.
/// @param points  of one profile, at least 2.
/// @param sigma_samples  from smoothing_sigma(); below 0.4 the points stay as they are.
/// @source  Arold et al., "Single Registration" (Gaussian filter along each line profile);
///          local regression: Fan and Gijbels, "Local Polynomial Modelling", 1996.
[[nodiscard]] std::vector<SmoothedPoint> smooth_profile(std::span<const ProfilePoint> points,
                                                        double sigma_samples);

}  // namespace flytri
