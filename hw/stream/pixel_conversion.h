/// @file  Converts the bytes of a camera buffer to an image. Pure functions.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

#include "hw/device/camera.h"

namespace flytri::stream {

/// Memory layout of an image in a buffer.
struct BufferLayout {
  device::PixelFormat format = device::PixelFormat::kGrey8;
  ImageSize size;
  std::size_t bytes_per_line = 0;  ///< at least the bytes of a row; unused for kMjpeg
  int bits = 16;                   ///< 8..16, used bits of a pixel of kGrey16
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

/// The bits that the pixels of a Y16 image seem to use: 10, 12, 14 or 16. Too few if it is dark.
[[nodiscard]] int bits_used(std::span<const std::uint8_t> bytes, const BufferLayout& layout);

/// Shifts Y10, Y12 and Y16 to the full scale of 16 bits. Converts YUYV and UYVY to RGB (BT.601,
/// limited range, as UVC devices send it), or takes their luminance unchanged. Interpolates Bayer
/// images bilinearly.
[[nodiscard]] ConvertedImage convert(std::span<const std::uint8_t> bytes,
                                     const BufferLayout& layout, device::Channels channels);

}  // namespace flytri::stream
