/// @file  From linked peaks to line samples: estimates the noise of the image and fits every sample
///          with it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/localization/background.h"
#include "core/localization/line_trace.h"
#include "core/localization/link_traces.h"

namespace flytri::localization {

/// How the position across the line is computed.
enum class LineEstimator {
  kWeightedFit,  ///< a Gaussian fitted to all pixels of the line, weighted with their noise
  kThreePoint,   ///< three-point Gaussian interpolation of the smoothed row, as in the paper
};

struct RefineOptions {
  LineEstimator estimator = LineEstimator::kWeightedFit;
  float full_scale = 255.0F;  ///< gray value at which the camera clips
  /// The background beside a line is that of the tile: the flanks of neighboring lines cover it.
  bool is_dense = false;
};

/// Fits every peak with the noise model of the image and the line's own width.
///
/// Width and background are measured in single rows and then smoothed along the trace: they change
/// slowly, and single rows are noisy. The uncertainty follows from the noise model, scaled by the
/// measured scatter of the traces: the model does not contain the speckle that neighboring pixels
/// share.
/// @param rows  CV_32FC1; lines cross the rows.
/// @return the traces in the order given, without samples that could not be fitted.
[[nodiscard]] std::vector<LineTrace> refine_traces(const cv::Mat& rows,
                                                   const Background& background,
                                                   const std::vector<PeakTrace>& traces,
                                                   const RefineOptions& options);

}  // namespace flytri::localization
