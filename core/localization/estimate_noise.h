/// @file  The noise of an image, measured from the image.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"
#include "core/localization/fit_line.h"
#include "core/localization/line_trace.h"

namespace flytri::localization {

/// Reading noise from the unlit pixels, shot noise and speckle from what fits leave on the lines.
/// @param fits, fit_rows  parallel: lines, and the rows of the image that they were fitted in.
[[nodiscard]] NoiseModel estimate_noise(const cv::Mat& rows, const Background& background,
                                        const std::vector<LineFit>& fits,
                                        const std::vector<int>& fit_rows, float full_scale);

/// How much larger the scatter of the samples about a smooth curve is than their sigma_px says:
/// the median over all places of the traces of a third difference, which a smooth curve does not
/// show. 1 where there are too few samples to tell.
[[nodiscard]] float scatter_ratio(const std::vector<LineTrace>& traces);

}  // namespace flytri::localization
