/// @file  Estimates the noise of an image from the image itself.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"
#include "core/localization/fit_line.h"
#include "core/localization/line_trace.h"

namespace flytri::localization {

/// Reading noise comes from the unlit pixels, shot noise and speckle from the residuals of the line
/// fits.
/// @param fits, fit_rows  parallel: fitted lines, and the image row of each.
[[nodiscard]] NoiseModel estimate_noise(const cv::Mat& rows, const Background& background,
                                        const std::vector<LineFit>& fits,
                                        const std::vector<int>& fit_rows, float full_scale);

/// Ratio of the measured scatter of the samples to their sigma_px. The scatter is the median of
/// third differences along the traces, which are near zero for a smooth curve. 1 if there are too
/// few samples.
[[nodiscard]] float scatter_ratio(const std::vector<LineTrace>& traces);

}  // namespace flytri::localization
