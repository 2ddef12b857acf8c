/// @file  From linked peaks to line samples: the noise of the image is measured, and every sample
/// is fitted with it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"
#include "core/localization/line_trace.h"
#include "core/localization/link_traces.h"

namespace flytri::localization {

/// How the position across the line is told.
enum class LineEstimator {
  kWeightedFit,  ///< a Gaussian fitted to all pixels of the line, weighted with their noise
  kThreePoint,   ///< three-point Gaussian interpolation of the smoothed row, as the paper has it
};

struct RefineOptions {
  LineEstimator estimator = LineEstimator::kWeightedFit;
  float full_scale = 255.0F;  ///< gray value at which the camera clips
};

/// Fits every peak with the noise model of the image and the line's own width.
///
/// Width and background are measured in single rows and then smoothed along the trace: they change
/// slowly, and a row alone tells them badly. The uncertainty is that of the noise model, scaled by
/// the scatter that the traces show: speckle that neighboring pixels share is not in the model.
/// @param rows  CV_32FC1; lines cross the rows.
/// @return the traces in the order given, without samples that could not be fitted.
[[nodiscard]] std::vector<LineTrace> refine_traces(const cv::Mat& rows,
                                                   const Background& background,
                                                   const std::vector<PeakTrace>& traces,
                                                   const RefineOptions& options);

}  // namespace flytri::localization
