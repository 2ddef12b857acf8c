/// @file  Checks an image of the dot target at once: from the image to its dots and a verdict.
#pragma once

#include <opencv2/core.hpp>

#include "core/calibration/guide/shot_check_options.h"
#include "core/calibration/guide/shot_verdict.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// The dots of one image, and how the target lies in it.
struct DotShot {
  ShotVerdict verdict;
  Pixel origin;           ///< where the middle of dot (0, 0) is expected
  double pitch_px = 0.0;  ///< around the origin: root of the area of a mesh
};

/// The dot target in the image of either camera.
/// @param volume  the dots inside it must be there as far as they are in sight
[[nodiscard]] DotShot check_dots(const cv::Mat& image, const DotTarget& target,
                                 const MeasurementVolume& volume, const ShotCheckOptions& options);

}  // namespace flytri::calibration
