/// @file  Reads the content of the X server's screen.
#pragma once

#include <opencv2/core.hpp>

namespace flytri::testing {

/// @return  the upper left part of the screen, CV_8UC3, R, G, B order; empty without a display of
///          24 bits
[[nodiscard]] cv::Mat read_screen(int width_px, int height_px);

}  // namespace flytri::testing
