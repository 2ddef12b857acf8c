/// @file  The pixels of a PNG image from its compressed data.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <string_view>

namespace flytri::io {

/// Copies a row from PNG to an image, or back. In PNG, the high byte of a 16-bit number comes
/// first.
/// @param depth  of the image
void copy_png_row(std::span<const std::uint8_t> from, int depth, std::uint8_t* to);

/// Unpacks rows that are not interlaced, and undoes their filters.
/// @param packed  what the IDAT chunks hold, one after the other
/// @param image   has the size and type of the result: CV_8UC1, CV_16UC1, or CV_8UC3 as R, G, B
/// @source  ISO/IEC 15948:2004 (PNG), section 9
/// @return  false if the data are damaged
[[nodiscard]] bool unpack_png_pixels(std::string_view packed, cv::Mat& image);

}  // namespace flytri::io
