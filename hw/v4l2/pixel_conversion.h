/// @file  Converts the bytes of a camera buffer to an image. Pure functions.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

#include "hw/device/camera.h"

namespace flytri::v4l2 {

/// Memory layout of an image in a buffer.
struct BufferLayout {
  device::PixelFormat format = device::PixelFormat::kGrey8;
  ImageSize size;
  std::size_t bytes_per_line = 0;  ///< at least the bytes of a row; unused for kMjpeg
};

/// Bytes of a complete image, without the padding of the last row; 0 for kMjpeg.
[[nodiscard]] std::size_t bytes_needed(const BufferLayout& layout);

enum class Conversion {
  kDone,
  kShort,        ///< bytes are missing; incomplete rows are black
  kUndecodable,  ///< a damaged or truncated compressed image; all pixels are black
};

struct ConvertedImage {
  cv::Mat image;  ///< type as in CameraFrame::image; owns its memory
  Conversion outcome = Conversion::kDone;
};

/// Shifts Y10 and Y12 to the full scale of 16 bits. Converts YUYV to RGB (BT.601, limited range, as
/// UVC devices send it), or takes its luminance unchanged.
[[nodiscard]] ConvertedImage convert(std::span<const std::uint8_t> bytes,
                                     const BufferLayout& layout, device::Channels channels);

}  // namespace flytri::v4l2
