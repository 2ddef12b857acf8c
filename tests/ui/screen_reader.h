/// @file  Reads what the X server has on its screen.
#pragma once

#include <opencv2/core.hpp>

namespace flytri::testing {

/// @return  the screen's upper left corner of that size, CV_8UC3, R, G, B order; empty where there
///          is no display or none of 24 bits
[[nodiscard]] cv::Mat read_screen(int width_px, int height_px);

}  // namespace flytri::testing
