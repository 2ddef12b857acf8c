/// @file  From a measurement image to sub-pixel line samples, linked along the lines.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/imaging/pattern.h"
#include "core/localization/background.h"
#include "core/localization/line_trace.h"
#include "core/localization/refine_traces.h"
#include "core/localization/trim_traces.h"

namespace flytri::localization {

/// How lines are found. Lengths are in pixels, because the camera's sampling limits them.
struct LocalizeOptions {
  /// 0.5..3. Gaussian smoothing before the search for peaks: narrower than any line, wide enough to
  /// reduce pixel noise.
  double detection_sigma_px = 1.0;
  /// 3..20. Height of a peak above the local background, in standard deviations of the smoothed
  /// background noise. At 5, about one pixel in 10^6 is a false peak.
  double detection_threshold = 5.0;
  /// 1..10. Largest slope of a line, pixels across per pixel along.
  double max_slope = 2.0;
  /// The weighted fit has a third less noise under speckle; the other one is for comparison.
  LineEstimator estimator = LineEstimator::kWeightedFit;
  /// 0.05..0.5. Share of the pixels of a tile of 64 x 64 px that are surely between the lines.
  /// Below 0.5 the lines count as dense: there is no background beside each one.
  double dark_share = Background::kHalf;
  /// How ends of lines and depth steps are treated.
  TrimOptions trim;

  [[nodiscard]] Result<void> validate() const;
};

/// Finds all lines of one pattern.
/// @param image  CV_8UC1 or CV_16UC1, linear in light, any black level.
/// @return traces by rising first row and then rising position across.
/// @source  Arold et al., "Line Localization": Gaussian smoothing and three-point Gaussian
///          interpolation find and link the peaks; their final position is a Gaussian fit weighted
///          with the noise of the image, which halves the paper's uncertainty under speckle.
/// @errors  kBadOption for options out of range, kBadFormat for another type of image.
[[nodiscard]] Result<std::vector<LineTrace>> localize_lines(const cv::Mat& image, Pattern pattern,
                                                            const LocalizeOptions& options);

/// The same options for lines so dense that their unique areas overlap.
[[nodiscard]] LocalizeOptions for_dense_lines(LocalizeOptions options);

}  // namespace flytri::localization
