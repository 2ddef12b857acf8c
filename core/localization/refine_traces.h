/// @file  From linked peaks to line samples: the noise of the image is measured, and every sample
/// is fitted with it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"
#include "core/localization/line_trace.h"
#include "core/localization/link_traces.h"

namespace flytri {

/// Fits every peak with the noise model of the image and the line's own width.
///
/// The width is fitted in each row and then smoothed along the trace: optics change it slowly, and
/// a row alone tells it badly. The uncertainty is that of the noise model, scaled by the scatter
/// that the traces show: speckle that neighboring pixels share is not in the model.
/// @param rows  CV_32FC1; lines cross the rows.
/// @return as many traces as given, some of them with fewer samples.
[[nodiscard]] std::vector<LineTrace> refine_traces(const cv::Mat& rows,
                                                   const Background& background,
                                                   const std::vector<PeakTrace>& traces,
                                                   float full_scale);

}  // namespace flytri
