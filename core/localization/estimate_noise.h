/// @file  Estimates the noise of an image from the image itself.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"
#include "core/localization/fit_line.h"
#include "core/localization/line_trace.h"

namespace flytri::localization {

/// Fitted lines, and the image row of each.
struct FittedLines {
  std::vector<LineFit> fits;
  std::vector<int> rows;  ///< parallel
};

/// Reading noise comes from the unlit pixels, shot noise and speckle from the residuals of the line
/// fits.
/// @param is_dense  as in RefineOptions
[[nodiscard]] NoiseModel estimate_noise(const cv::Mat& rows, const Background& background,
                                        const FittedLines& lines, float full_scale, bool is_dense);

/// Ratio of the measured scatter of the samples to their sigma_px. The scatter is the median of
/// third differences along the traces, which are near zero for a smooth curve. 1 if there are too
/// few samples.
[[nodiscard]] float scatter_ratio(const std::vector<LineTrace>& traces);

}  // namespace flytri::localization
