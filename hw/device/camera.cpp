#include "hw/device/camera.h"

#include <array>
#include <utility>

namespace flytri::device {

namespace {

constexpr std::array kFormatNames = {std::pair{PixelFormat::kGrey8, std::string_view("GREY")},
                                     std::pair{PixelFormat::kGrey10, std::string_view("Y10")},
                                     std::pair{PixelFormat::kGrey12, std::string_view("Y12")},
                                     std::pair{PixelFormat::kGrey16, std::string_view("Y16")},
                                     std::pair{PixelFormat::kYuyv, std::string_view("YUYV")},
                                     std::pair{PixelFormat::kMjpeg, std::string_view("MJPG")}};

}  // namespace

std::string_view to_string(PixelFormat format) {
  for (const auto& [candidate, name] : kFormatNames)
    if (candidate == format) return name;
  return {};
}

std::optional<PixelFormat> pixel_format_of(std::string_view name) {
  for (const auto& [format, candidate] : kFormatNames)
    if (candidate == name) return format;
  return std::nullopt;
}

std::string_view to_string(CameraState state) {
  switch (state) {
    case CameraState::kIdle:
      return "idle";
    case CameraState::kRunning:
      return "running";
    case CameraState::kFrozen:
      return "frozen";
    case CameraState::kLost:
      return "lost";
    case CameraState::kFailed:
      break;
  }
  return "failed";
}

Result<void> CameraSettings::validate() const {
  if (size.width_px <= 0 || size.height_px <= 0)
    return fail(ErrorCode::kBadOption, "camera size {} x {}: must be at least 1 x 1 px",
                size.width_px, size.height_px);
  if (!(rate_hz > 0.0))
    return fail(ErrorCode::kBadOption, "camera rate {} Hz: must be above 0", rate_hz);
  if (exposure_s && !(*exposure_s > 0.0))
    return fail(ErrorCode::kBadOption, "camera exposure {} s: must be above 0", *exposure_s);
  if (white_balance_k && !(*white_balance_k > 0.0))
    return fail(ErrorCode::kBadOption, "camera white balance {} K: must be above 0",
                *white_balance_k);
  return {};
}

}  // namespace flytri::device
