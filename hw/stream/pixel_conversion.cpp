#include "hw/stream/pixel_conversion.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "hw/stream/jpeg_decoder.h"

namespace flytri::stream {

namespace {

/// Two pixels share their color.
bool is_packed_yuv(device::PixelFormat format) {
  return format == device::PixelFormat::kYuyv || format == device::PixelFormat::kUyvy;
}

bool is_grey(device::PixelFormat format) {
  return format == device::PixelFormat::kGrey8 || format == device::PixelFormat::kGrey10 ||
         format == device::PixelFormat::kGrey12 || format == device::PixelFormat::kGrey16;
}

/// OpenCV's conversion of a Bayer format; nothing for others.
std::optional<int> bayer_conversion(device::PixelFormat format, device::Channels channels) {
  const bool is_rgb = channels == device::Channels::kRgb;
  switch (format) {
    case device::PixelFormat::kBayerRggb:
      return is_rgb ? cv::COLOR_BayerBG2RGB : cv::COLOR_BayerBG2GRAY;
    case device::PixelFormat::kBayerGrbg:
      return is_rgb ? cv::COLOR_BayerGB2RGB : cv::COLOR_BayerGB2GRAY;
    case device::PixelFormat::kBayerGbrg:
      return is_rgb ? cv::COLOR_BayerGR2RGB : cv::COLOR_BayerGR2GRAY;
    case device::PixelFormat::kBayerBggr:
      return is_rgb ? cv::COLOR_BayerRG2RGB : cv::COLOR_BayerRG2GRAY;
    default:
      return std::nullopt;
  }
}

/// Type of the packed rows.
int packed_type(device::PixelFormat format) {
  if (is_packed_yuv(format)) return CV_8UC2;
  if (format == device::PixelFormat::kRgb8) return CV_8UC3;
  return is_grey(format) && format != device::PixelFormat::kGrey8 ? CV_16UC1 : CV_8UC1;
}

std::size_t bytes_per_pixel(device::PixelFormat format) {
  return CV_ELEM_SIZE(packed_type(format));
}

// Left shift that moves the highest bit of a pixel to bit 15.
int shift_to_full_scale(const BufferLayout& layout) {
  if (layout.format == device::PixelFormat::kGrey10) return 6;
  if (layout.format == device::PixelFormat::kGrey12) return 4;
  return 16 - layout.bits;
}

std::size_t row_bytes(const BufferLayout& layout) {
  return static_cast<std::size_t>(layout.size.width_px) * bytes_per_pixel(layout.format);
}

cv::Mat black(const BufferLayout& layout, device::Channels channels) {
  int type = CV_8UC1;
  if (is_grey(layout.format))
    type = layout.format == device::PixelFormat::kGrey8 ? CV_8UC1 : CV_16UC1;
  else if (channels == device::Channels::kRgb)
    type = CV_8UC3;
  return cv::Mat::zeros(layout.size.height_px, layout.size.width_px, type);
}

// Number of complete rows; an incomplete row counts as missing.
int whole_rows(std::size_t bytes, const BufferLayout& layout) {
  if (bytes < row_bytes(layout)) return 0;
  const std::size_t rows = 1 + (bytes - row_bytes(layout)) / layout.bytes_per_line;
  return static_cast<int>(std::min<std::size_t>(rows, layout.size.height_px));
}

void convert_yuv(const cv::Mat& packed, bool is_luminance_first, device::Channels channels,
                 cv::Mat target) {
  if (channels == device::Channels::kRgb)
    cv::cvtColor(packed, target,
                 is_luminance_first ? cv::COLOR_YUV2RGB_YUYV : cv::COLOR_YUV2RGB_UYVY);
  else
    cv::extractChannel(packed, target, is_luminance_first ? 0 : 1);
}

void convert_rgb(const cv::Mat& packed, device::Channels channels, cv::Mat target) {
  if (channels == device::Channels::kRgb)
    packed.copyTo(target);
  else
    cv::cvtColor(packed, target, cv::COLOR_RGB2GRAY);
}

// Assumes little-endian 16-bit samples on a little-endian machine.
void convert_rows(const cv::Mat& packed, const BufferLayout& layout, device::Channels channels,
                  cv::Mat target) {
  switch (layout.format) {
    case device::PixelFormat::kGrey8:
      packed.copyTo(target);
      break;
    case device::PixelFormat::kGrey10:
    case device::PixelFormat::kGrey12:
    case device::PixelFormat::kGrey16:
      packed.convertTo(target, CV_16U, 1 << shift_to_full_scale(layout));
      break;
    case device::PixelFormat::kYuyv:
    case device::PixelFormat::kUyvy:
      convert_yuv(packed, layout.format == device::PixelFormat::kYuyv, channels, target);
      break;
    case device::PixelFormat::kRgb8:
      convert_rgb(packed, channels, target);
      break;
    default:
      // OpenCV cannot interpolate in fewer rows.
      if (const auto bayer = bayer_conversion(layout.format, channels);
          bayer && packed.rows >= 3 && packed.cols >= 3)
        cv::cvtColor(packed, target, *bayer);
  }
}

/// The bytes as an image, not copied.
cv::Mat packed_rows(std::span<const std::uint8_t> bytes, const BufferLayout& layout, int rows) {
  // cv::Mat has no const data pointer; the data is only read.
  return {rows, layout.size.width_px, packed_type(layout.format),
          const_cast<std::uint8_t*>(bytes.data()), layout.bytes_per_line};
}

ConvertedImage convert_uncompressed(std::span<const std::uint8_t> bytes, const BufferLayout& layout,
                                    device::Channels channels) {
  ConvertedImage converted{black(layout, channels)};
  const int rows = whole_rows(bytes.size(), layout);
  if (rows < layout.size.height_px) converted.outcome = Conversion::kShort;
  if (rows == 0) return converted;
  const cv::Mat packed = packed_rows(bytes, layout, rows);
  convert_rows(packed, layout, channels, converted.image.rowRange(0, rows));
  return converted;
}

ConvertedImage decode(std::span<const std::uint8_t> bytes, const BufferLayout& layout,
                      device::Channels channels) {
  ConvertedImage converted{black(layout, channels)};
  if (decode_jpeg(bytes, converted.image)) return converted;
  return {black(layout, channels), Conversion::kUndecodable};
}

}  // namespace

std::size_t bytes_needed(const BufferLayout& layout) {
  if (layout.format == device::PixelFormat::kMjpeg) return 0;
  return static_cast<std::size_t>(layout.size.height_px - 1) * layout.bytes_per_line +
         row_bytes(layout);
}

int bits_used(std::span<const std::uint8_t> bytes, const BufferLayout& layout) {
  constexpr std::array kUsual = {10, 12, 14};
  const int rows = whole_rows(bytes.size(), layout);
  if (rows == 0) return kUsual.front();
  double brightest = 0.0;
  cv::minMaxLoc(packed_rows(bytes, layout, rows), nullptr, &brightest);
  for (const int bits : kUsual)
    if (brightest < 1 << bits) return bits;
  return 16;
}

ConvertedImage convert(std::span<const std::uint8_t> bytes, const BufferLayout& layout,
                       device::Channels channels) {
  if (layout.format == device::PixelFormat::kMjpeg) return decode(bytes, layout, channels);
  return convert_uncompressed(bytes, layout, channels);
}

}  // namespace flytri::stream
