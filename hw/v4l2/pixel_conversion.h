/// @file  Bytes of a camera's buffer in, an image out. Pure functions.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

#include "hw/device/camera.h"

namespace flytri::v4l2 {

/// How the pixels lie in a buffer.
struct BufferLayout {
  device::PixelFormat format = device::PixelFormat::kGrey8;
  ImageSize size;
  std::size_t bytes_per_line = 0;  ///< at least what a row needs; nothing to kMjpeg
};

/// Bytes that a whole image takes up, the padding of the last row left out; 0: kMjpeg.
[[nodiscard]] std::size_t bytes_needed(const BufferLayout& layout);

enum class Conversion {
  kDone,
  kShort,        ///< bytes are missing; the rows that they would fill are black
  kUndecodable,  ///< compressed, and damaged or cut off; all is black
};

struct ConvertedImage {
  cv::Mat image;  ///< as CameraFrame::image says; own memory
  Conversion outcome = Conversion::kDone;
};

/// Y10 and Y12 are shifted to the full scale of 16 bits. YUYV becomes RGB by BT.601 with limited
/// range, as UVC devices send it, or its luminance as it is.
[[nodiscard]] ConvertedImage convert(std::span<const std::uint8_t> bytes,
                                     const BufferLayout& layout, device::Channels channels);

}  // namespace flytri::v4l2
