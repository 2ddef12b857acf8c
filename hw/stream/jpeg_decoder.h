/// @file  Decodes the JPEG images of a camera.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

namespace flytri::stream {

/// Tolerates stray bytes before a marker, which some cameras send with every image: they change no
/// pixel. Any other damage counts, for example missing data.
/// @param image  of the expected size; CV_8UC3 for R, G, B, or CV_8UC1 for the luminance
/// @return  false: the image is damaged, or has another size; the pixels are then meaningless
[[nodiscard]] bool decode_jpeg(std::span<const std::uint8_t> bytes, cv::Mat& image);

}  // namespace flytri::stream
