#include "hw/device/camera.h"

#include <array>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::device {

namespace {

constexpr std::array kFormatNames = {std::pair{PixelFormat::kGrey8, std::string_view("GREY")},
                                     std::pair{PixelFormat::kGrey10, std::string_view("Y10")},
                                     std::pair{PixelFormat::kGrey12, std::string_view("Y12")},
                                     std::pair{PixelFormat::kGrey16, std::string_view("Y16")},
                                     std::pair{PixelFormat::kYuyv, std::string_view("YUYV")},
                                     std::pair{PixelFormat::kUyvy, std::string_view("UYVY")},
                                     std::pair{PixelFormat::kMjpeg, std::string_view("MJPG")},
                                     std::pair{PixelFormat::kRgb8, std::string_view("RGB3")},
                                     std::pair{PixelFormat::kBayerRggb, std::string_view("RGGB")},
                                     std::pair{PixelFormat::kBayerGrbg, std::string_view("GRBG")},
                                     std::pair{PixelFormat::kBayerGbrg, std::string_view("GBRG")},
                                     std::pair{PixelFormat::kBayerBggr, std::string_view("BA81")}};

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

std::string pixel_format_names() {
  std::string names(kFormatNames.front().second);
  for (std::size_t i = 1; i < kFormatNames.size(); ++i)
    names += (i + 1 < kFormatNames.size() ? ", " : " or ") + std::string(kFormatNames[i].second);
  return names;
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
  OptionCheck check("CameraSettings");
  check.at_least("size.width_px", size.width_px, 1)
      .at_least("size.height_px", size.height_px, 1)
      .positive("rate_hz", rate_hz);
  if (exposure_s) check.positive("exposure_s", *exposure_s);
  if (bits) {
    check.in_range("bits", *bits, 8, 16)
        .must("bits", *bits, format == PixelFormat::kGrey16, "left out: only Y16 has it");
  }
  if (white_balance_k) check.positive("white_balance_k", *white_balance_k);
  return check.result();
}

}  // namespace flytri::device
