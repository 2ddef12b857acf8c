/// @file  Rejects calibration sets that cannot be fitted, before the fit starts.
#pragma once

#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// An image of the measurement camera is gray and as large as the first one.
/// @errors  kBadFormat or kInconsistent, naming the image.
[[nodiscard]] Result<void> check_gray_image(const cv::Mat& image, const std::string& name,
                                            const cv::Mat& first, const std::string& first_name);

/// An image of the texture camera is in color and as large as the first one. All placements have
/// one, or none has.
/// @errors  As check_gray_image.
[[nodiscard]] Result<void> check_texture_image(const cv::Mat& image, const std::string& name,
                                               const cv::Mat& first, const std::string& first_name);

/// @errors  kInconsistent, naming the entry.
[[nodiscard]] Result<void> check_scene(const CalibrationScene& scene);

/// Checks a set without its images.
/// @param z_mm  depths of the planes
/// @errors  kInsufficient or kInconsistent, naming the entry.
[[nodiscard]] Result<void> check_numbers(const CalibrationScene& scene,
                                         const std::vector<double>& z_mm);

/// @errors  kInsufficient or kInconsistent, naming the image or the entry.
[[nodiscard]] Result<void> check_set(const CalibrationSet& set);

}  // namespace flytri::calibration
