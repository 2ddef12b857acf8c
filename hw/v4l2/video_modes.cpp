#include "hw/v4l2/video_modes.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <functional>

#include "hw/v4l2/video_failure.h"

namespace flytri::v4l2 {

namespace {

constexpr auto kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;
// Limit in case a driver's list never ends.
constexpr std::uint32_t kMaxEntries = 256;

std::uint32_t fourcc_of(device::PixelFormat format) {
  switch (format) {
    case device::PixelFormat::kGrey8:
      return V4L2_PIX_FMT_GREY;
    case device::PixelFormat::kGrey10:
      return V4L2_PIX_FMT_Y10;
    case device::PixelFormat::kGrey12:
      return V4L2_PIX_FMT_Y12;
    case device::PixelFormat::kGrey16:
      return V4L2_PIX_FMT_Y16;
    case device::PixelFormat::kYuyv:
      return V4L2_PIX_FMT_YUYV;
    case device::PixelFormat::kUyvy:
      return V4L2_PIX_FMT_UYVY;
    case device::PixelFormat::kRgb8:
      return V4L2_PIX_FMT_RGB24;
    case device::PixelFormat::kBayerRggb:
      return V4L2_PIX_FMT_SRGGB8;
    case device::PixelFormat::kBayerGrbg:
      return V4L2_PIX_FMT_SGRBG8;
    case device::PixelFormat::kBayerGbrg:
      return V4L2_PIX_FMT_SGBRG8;
    case device::PixelFormat::kBayerBggr:
      return V4L2_PIX_FMT_SBGGR8;
    case device::PixelFormat::kMjpeg:
      break;
  }
  return V4L2_PIX_FMT_MJPEG;
}

// The four letters without trailing blanks.
std::string letters_of(std::uint32_t fourcc) {
  std::string letters;
  for (int shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>(fourcc >> shift & 0x7f);
    letters += letter >= ' ' ? letter : '?';
  }
  letters.erase(letters.find_last_not_of(' ') + 1);
  return letters;
}

double rate_of(const v4l2_fract& period_s) {
  return period_s.numerator == 0 ? 0.0 : 1.0 * period_s.denominator / period_s.numerator;
}

std::vector<double> list_rates(VideoDevice& device, std::uint32_t fourcc, const ImageSize& size) {
  std::vector<double> rates_hz;
  for (std::uint32_t i = 0; i < kMaxEntries; ++i) {
    v4l2_frmivalenum entry{};
    entry.index = i;
    entry.pixel_format = fourcc;
    entry.width = static_cast<std::uint32_t>(size.width_px);
    entry.height = static_cast<std::uint32_t>(size.height_px);
    if (device.control(VIDIOC_ENUM_FRAMEINTERVALS, &entry) != 0) break;
    if (entry.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      rates_hz.push_back(rate_of(entry.discrete));
      continue;
    }
    rates_hz = {rate_of(entry.stepwise.min), rate_of(entry.stepwise.max)};
    break;
  }
  std::sort(rates_hz.begin(), rates_hz.end(), std::greater<>());
  return rates_hz;
}

ImageSize size_of(std::uint32_t width, std::uint32_t height) {
  return {static_cast<int>(width), static_cast<int>(height)};
}

void list_sizes(VideoDevice& device, std::uint32_t fourcc, std::vector<device::CameraMode>& modes) {
  const auto add = [&](const ImageSize& size) {
    modes.push_back({letters_of(fourcc), size, list_rates(device, fourcc, size)});
  };
  for (std::uint32_t i = 0; i < kMaxEntries; ++i) {
    v4l2_frmsizeenum entry{};
    entry.index = i;
    entry.pixel_format = fourcc;
    if (device.control(VIDIOC_ENUM_FRAMESIZES, &entry) != 0) break;
    if (entry.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      add(size_of(entry.discrete.width, entry.discrete.height));
      continue;
    }
    add(size_of(entry.stepwise.min_width, entry.stepwise.min_height));
    add(size_of(entry.stepwise.max_width, entry.stepwise.max_height));
    break;
  }
}

// At most eight, to keep the message short.
std::string names_of(const std::vector<device::CameraMode>& modes) {
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(modes.size(), 8); ++i)
    names += fmt::format("{}{} {} x {}", i == 0 ? "" : ", ", modes[i].format,
                         modes[i].size.width_px, modes[i].size.height_px);
  return modes.size() > 8 ? names + ", ..." : names;
}

Result<double> set_rate(const OpenVideo& video, double rate_hz) {
  v4l2_streamparm parameters{};
  parameters.type = kCapture;
  const int known = video.device.control(VIDIOC_G_PARM, &parameters);
  // Without support for setting the rate, the camera keeps its own rate.
  if (known != 0 || !(parameters.parm.capture.capability & V4L2_CAP_TIMEPERFRAME)) return rate_hz;
  parameters.parm.capture.timeperframe = {
      1000, static_cast<std::uint32_t>(std::lround(rate_hz * 1000.0))};
  const int error = video.device.control(VIDIOC_S_PARM, &parameters);
  if (error != 0)
    return tl::unexpected(
        video_failure(video.node, fmt::format("setting the rate to {} Hz", rate_hz), error));
  const double agreed_hz = rate_of(parameters.parm.capture.timeperframe);
  return agreed_hz > 0.0 ? agreed_hz : rate_hz;
}

// request: VIDIOC_S_FMT or VIDIOC_TRY_FMT.
Result<v4l2_pix_format> agree(const OpenVideo& video, const device::CameraSettings& settings,
                              unsigned long request) {
  v4l2_format format{};
  format.type = kCapture;
  auto& pixels = format.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(settings.size.width_px);
  pixels.height = static_cast<std::uint32_t>(settings.size.height_px);
  pixels.pixelformat = fourcc_of(settings.format);
  pixels.field = V4L2_FIELD_NONE;
  const int error = video.device.control(request, &format);
  if (error != 0 && error != EINVAL)
    return tl::unexpected(video_failure(video.node, "setting the format", error));
  // A driver that does not support the mode chooses a similar one instead.
  if (error == 0 && pixels.pixelformat == fourcc_of(settings.format) &&
      size_of(pixels.width, pixels.height) == settings.size)
    return pixels;
  return fail(ErrorCode::kBadOption,
              "camera {} does not offer {} with {} x {} pixels: choose one of {}",
              to_string(video.node), to_string(settings.format), settings.size.width_px,
              settings.size.height_px, names_of(list_modes(video.device)));
}

}  // namespace

std::vector<device::CameraMode> list_modes(VideoDevice& device) {
  std::vector<device::CameraMode> modes;
  for (std::uint32_t i = 0; i < kMaxEntries; ++i) {
    v4l2_fmtdesc entry{};
    entry.index = i;
    entry.type = kCapture;
    if (device.control(VIDIOC_ENUM_FMT, &entry) != 0) break;
    list_sizes(device, entry.pixelformat, modes);
  }
  return modes;
}

Result<void> check_mode(const OpenVideo& video, const device::CameraSettings& settings) {
  const auto pixels = agree(video, settings, VIDIOC_TRY_FMT);
  if (!pixels) return tl::unexpected(pixels.error());
  return {};
}

Result<AgreedMode> set_mode(const OpenVideo& video, const device::CameraSettings& settings) {
  const auto pixels = agree(video, settings, VIDIOC_S_FMT);
  if (!pixels) return tl::unexpected(pixels.error());
  const auto rate = set_rate(video, settings.rate_hz);
  if (!rate) return tl::unexpected(rate.error());
  // Some drivers report no line length if lines have no padding.
  const stream::BufferLayout one_line{settings.format, {settings.size.width_px, 1}, 0, 16};
  const auto bytes_per_line =
      std::max<std::size_t>(pixels->bytesperline, stream::bytes_needed(one_line));
  return AgreedMode{{settings.format, settings.size, bytes_per_line, settings.bits.value_or(16)},
                    *rate};
}

}  // namespace flytri::v4l2
