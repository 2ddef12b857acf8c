/// @file  The pixels of a PNG image from its compressed data.
#pragma once

#include <opencv2/core.hpp>
#include <string_view>

namespace flytri::io {

/// Unpacks rows that are not interlaced, and undoes their filters.
/// @param packed  what the IDAT chunks hold, one after the other
/// @param image   its size and type are those of the result, CV_8UC1, CV_16UC1 or CV_8UC3 in R, G,
///                B order
/// @source  ISO/IEC 15948:2004 (PNG), section 9
/// @return  false if the data are damaged
[[nodiscard]] bool unpack_png_pixels(std::string_view packed, cv::Mat& image);

}  // namespace flytri::io
