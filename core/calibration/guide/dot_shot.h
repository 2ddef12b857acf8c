/// @file  Checks an image of the dot target.
#pragma once

#include <opencv2/core.hpp>

#include "core/calibration/guide/shot_check_options.h"
#include "core/calibration/guide/shot_verdict.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// The result, with the position of the target in the image.
struct DotShot {
  ShotVerdict verdict;
  Pixel origin;           ///< expected center of dot (0, 0)
  double pitch_px = 0.0;  ///< at the origin: square root of the area of a grid cell
};

/// Checks the dot target in an image of either camera.
/// @param volume  all its dots that are in sight must be found
[[nodiscard]] DotShot check_dots(const cv::Mat& image, const DotTarget& target,
                                 const MeasurementVolume& volume, const ShotCheckOptions& options);

}  // namespace flytri::calibration
