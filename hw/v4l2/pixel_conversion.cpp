#include "hw/v4l2/pixel_conversion.h"

#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <opencv2/imgproc.hpp>

namespace flytri::v4l2 {

namespace {

bool is_grey(device::PixelFormat format) {
  return format != device::PixelFormat::kYuyv && format != device::PixelFormat::kMjpeg;
}

std::size_t bytes_per_pixel(device::PixelFormat format) {
  return format == device::PixelFormat::kGrey8 ? 1 : 2;
}

// Left shift that moves the highest bit of a pixel to bit 15.
int shift_to_full_scale(device::PixelFormat format) {
  if (format == device::PixelFormat::kGrey10) return 6;
  if (format == device::PixelFormat::kGrey12) return 4;
  return 0;
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

// Assumes little-endian 16-bit samples on a little-endian machine.
void convert_rows(const cv::Mat& packed, const BufferLayout& layout, device::Channels channels,
                  cv::Mat target) {
  switch (layout.format) {
    case device::PixelFormat::kGrey8:
    case device::PixelFormat::kGrey16:
      packed.copyTo(target);
      break;
    case device::PixelFormat::kGrey10:
    case device::PixelFormat::kGrey12:
      packed.convertTo(target, CV_16U, 1 << shift_to_full_scale(layout.format));
      break;
    case device::PixelFormat::kYuyv:
      if (channels == device::Channels::kRgb)
        cv::cvtColor(packed, target, cv::COLOR_YUV2RGB_YUYV);
      else
        cv::extractChannel(packed, target, 0);
      break;
    case device::PixelFormat::kMjpeg:
      break;
  }
}

ConvertedImage convert_uncompressed(std::span<const std::uint8_t> bytes, const BufferLayout& layout,
                                    device::Channels channels) {
  ConvertedImage converted{black(layout, channels)};
  const int rows = whole_rows(bytes.size(), layout);
  if (rows < layout.size.height_px) converted.outcome = Conversion::kShort;
  if (rows == 0) return converted;
  int type = CV_8UC1;
  if (layout.format == device::PixelFormat::kYuyv)
    type = CV_8UC2;
  else if (layout.format != device::PixelFormat::kGrey8)
    type = CV_16UC1;
  // cv::Mat has no const data pointer; the data is only read.
  const cv::Mat packed(rows, layout.size.width_px, type, const_cast<std::uint8_t*>(bytes.data()),
                       layout.bytes_per_line);
  convert_rows(packed, layout, channels, converted.image.rowRange(0, rows));
  return converted;
}

struct DecoderCloser {
  void operator()(void* decoder) const { tjDestroy(decoder); }
};

// Uses TurboJPEG because it reports damaged and truncated images, unlike OpenCV's decoder.
bool decode_into(std::span<const std::uint8_t> bytes, cv::Mat& image) {
  const std::unique_ptr<void, DecoderCloser> decoder(tjInitDecompress());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  const auto length = static_cast<unsigned long>(bytes.size());
  if (!decoder || tjDecompressHeader3(decoder.get(), bytes.data(), length, &width, &height,
                                      &subsampling, &color_space) != 0)
    return false;
  if (cv::Size(width, height) != image.size()) return false;
  const int pixels = image.channels() == 3 ? TJPF_RGB : TJPF_GRAY;
  return tjDecompress2(decoder.get(), bytes.data(), length, image.data, width,
                       static_cast<int>(image.step), height, pixels, TJFLAG_STOPONWARNING) == 0;
}

ConvertedImage decode(std::span<const std::uint8_t> bytes, const BufferLayout& layout,
                      device::Channels channels) {
  ConvertedImage converted{black(layout, channels)};
  if (decode_into(bytes, converted.image)) return converted;
  return {black(layout, channels), Conversion::kUndecodable};
}

}  // namespace

std::size_t bytes_needed(const BufferLayout& layout) {
  if (layout.format == device::PixelFormat::kMjpeg) return 0;
  return static_cast<std::size_t>(layout.size.height_px - 1) * layout.bytes_per_line +
         row_bytes(layout);
}

ConvertedImage convert(std::span<const std::uint8_t> bytes, const BufferLayout& layout,
                       device::Channels channels) {
  if (layout.format == device::PixelFormat::kMjpeg) return decode(bytes, layout, channels);
  return convert_uncompressed(bytes, layout, channels);
}

}  // namespace flytri::v4l2
