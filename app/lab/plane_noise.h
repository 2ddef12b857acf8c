/// @file  Extracts the noise of a sensor from the planes of its calibration set.
#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/calibration/record/calibration_set.h"
#include "hw/simulated/optics/measured_noise.h"

namespace flytri::lab {

/// Measures each plane image as a frame, and takes the residuals along z of each profile from a
/// polynomial of degree 5 along it. That removes what is systematic: errors of the calibration, a
/// tilt or bend of the plane. Noise slower than about a third of a profile is removed with it, so
/// the series have no noise of a whole profile or line.
/// @param exposures  >= 1, averaged in each image. If their noise is independent (that of
///                   speckle on a plane at rest is not), one has more by the square root.
/// @errors  As measure_view; kInsufficient: too few lines are seen inside the volume.
[[nodiscard]] Result<simulated::MeasuredNoise> plane_noise(
    const calibration::CalibrationSet& set, const calibration::Calibration& calibration,
    int exposures, const Workers& workers, const Progress& progress);

/// The same for a set on disk, calibrated from itself.
/// @param folder  contains calibration-set.json
/// @errors  As read_calibration_set, calibrate and plane_noise; messages name the folder.
[[nodiscard]] Result<simulated::MeasuredNoise> read_plane_noise(const std::filesystem::path& folder,
                                                                int exposures,
                                                                const Workers& workers,
                                                                const Progress& progress);

/// What the noise at one depth is like, both patterns together.
struct NoiseFigures {
  double sigma_mm = 0.0;   ///< standard deviation along z
  double stated_mm = 0.0;  ///< RMS of what the localization stated
  /// Standard deviation of the Gaussian that makes of white noise one with the same correlation of
  /// neighbors, in samples; 0: they are not correlated.
  double correlation_samples = 0.0;
  double kurtosis = 0.0;        ///< of a normal distribution: 3
  double beyond_3_sigma = 0.0;  ///< share of the samples; of a normal distribution: 0.0027
};

/// @param z_mm  the nearest plane is taken
[[nodiscard]] NoiseFigures noise_figures(const simulated::MeasuredNoise& noise, double z_mm);

}  // namespace flytri::lab
