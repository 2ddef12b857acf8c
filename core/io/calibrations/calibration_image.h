/// @file  Reads the images of calibration sets. Only for core/io/calibrations.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "core/base/result.h"

namespace flytri::io {

/// @param color  the image must be RGB, or else gray
/// @param size   of the earlier images of this camera, which this one must have; empty: set here
/// @errors  As read_png; kBadFormat, kInconsistent.
[[nodiscard]] Result<cv::Mat> load_calibration_image(const std::filesystem::path& path, bool color,
                                                     cv::Size& size);

}  // namespace flytri::io
