/// @file  Peaks of every image row: where lines cross it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"
#include "core/localization/line_trace.h"

namespace flytri {

/// What counts as a peak.
struct PeakOptions {
  double smoothing_sigma_px = 1.0;
  double threshold = 5.0;     ///< in standard deviations of the smoothed background noise
  float full_scale = 255.0F;  ///< gray value at which the camera clips
};

/// The peaks of each row by rising column.
/// @param rows  CV_32FC1; lines cross the rows.
[[nodiscard]] std::vector<std::vector<LineSample>> find_peaks(const cv::Mat& rows,
                                                              const Background& background,
                                                              const PeakOptions& options);

}  // namespace flytri
