/// @file  Peaks of every image row: where lines cross it, to a fraction of a pixel.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"

namespace flytri {

/// A peak of a smoothed row.
struct Peak {
  int row = 0;
  float center_px = 0;       ///< middle between the two flanks: calm even where the top is speckled
  float three_point_px = 0;  ///< by three-point Gaussian interpolation of the top
  float sigma_px = 0;        ///< of a Gaussian with these flanks, free of the smoothing
  float amplitude = 0;       ///< above the local background, free of the smoothing
  float room_px = 0;         ///< half the distance to the nearest other peak of the row
  bool saturated = false;
};

/// What counts as a peak.
struct PeakOptions {
  double smoothing_sigma_px = 1.0;
  double threshold = 5.0;     ///< in standard deviations of the smoothed background noise
  float full_scale = 255.0F;  ///< gray value at which the camera clips
};

/// The peaks of each row by rising column. Two maxima with hardly a valley between them are one
/// peak split by speckle.
/// @param rows  CV_32FC1; lines cross the rows.
/// @source  Arold et al., "Line Localization".
[[nodiscard]] std::vector<std::vector<Peak>> find_peaks(const cv::Mat& rows,
                                                        const Background& background,
                                                        const PeakOptions& options);

}  // namespace flytri
