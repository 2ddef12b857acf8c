/// @file  Sub-pixel centers of the bright dots in an image of the dot target.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/imaging/pattern.h"

namespace flytri::calibration {

/// One bright spot.
struct Dot {
  Pixel center;
  double area_px = 0.0;     ///< pixels above half height
  double brightness = 0.0;  ///< mean height above the local background, gray values
};

/// Finds all dots that are completely in the image, in the order of their first pixel.
///
/// The center is the centroid of light above the local background, corrected for the gradient of
/// the illumination, which would shift it to the brighter side. Blur does not shift it.
/// @param gray  CV_32FC1, linear in light.
[[nodiscard]] std::vector<Dot> find_dots(const cv::Mat& gray);

/// Converts a dot image of either camera to linear light, CV_32FC1.
/// @param image  CV_8UC1 or CV_16UC1 (linear) or CV_8UC3 (R, G, B order, sRGB).
[[nodiscard]] cv::Mat linear_gray(const cv::Mat& image);

}  // namespace flytri::calibration
