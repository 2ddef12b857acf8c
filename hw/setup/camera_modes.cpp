#include "hw/setup/camera_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace flytri::setup {
namespace {

using device::PixelFormat;

/// Share of the wanted rate below which a setting is slow.
constexpr double kSlow = 0.8;

/// 8 bits need half of the bandwidth of 16, and the noise of a camera is above their steps.
constexpr std::array kGreyFormats = {PixelFormat::kGrey8, PixelFormat::kGrey10,
                                     PixelFormat::kGrey12, PixelFormat::kGrey16};
constexpr std::array kColorFormats = {PixelFormat::kRgb8,      PixelFormat::kBayerRggb,
                                      PixelFormat::kBayerGrbg, PixelFormat::kBayerGbrg,
                                      PixelFormat::kBayerBggr, PixelFormat::kYuyv,
                                      PixelFormat::kUyvy,      PixelFormat::kMjpeg};

/// Smaller is better; nothing: unsuitable.
std::optional<int> rank_of(PixelFormat format, device::Channels channels) {
  const auto grey = std::find(kGreyFormats.begin(), kGreyFormats.end(), format);
  if (grey != kGreyFormats.end()) {
    if (channels == device::Channels::kRgb) return std::nullopt;
    return static_cast<int>(grey - kGreyFormats.begin());
  }
  const auto color = std::find(kColorFormats.begin(), kColorFormats.end(), format);
  const auto rank = static_cast<int>(color - kColorFormats.begin());
  // For gray values, YUYV has the luminance of each pixel; a Bayer image must be interpolated.
  const bool is_sharp = format == PixelFormat::kYuyv || format == PixelFormat::kUyvy;
  if (channels == device::Channels::kGrey) return (is_sharp ? 10 : 20) + rank;
  return rank;
}

/// Of the sensors in hw/simulated.
double usual_pixels(device::Channels channels) {
  return channels == device::Channels::kRgb ? 1280.0 * 960.0 : 1024.0 * 768.0;
}

double nearest_rate_hz(const std::vector<double>& rates_hz, double wanted_hz) {
  if (rates_hz.empty()) return wanted_hz;
  return *std::min_element(rates_hz.begin(), rates_hz.end(), [&](double a, double b) {
    return std::abs(a - wanted_hz) < std::abs(b - wanted_hz);
  });
}

}  // namespace

std::vector<device::CameraSettings> suitable_settings(const std::vector<device::CameraMode>& modes,
                                                      device::Channels channels, double wanted_hz) {
  struct Ranked {
    std::tuple<bool, int, double> rank;
    device::CameraSettings settings;
  };
  std::vector<Ranked> found;
  for (const device::CameraMode& mode : modes) {
    const auto format = device::pixel_format_of(mode.format);
    const auto rank = format ? rank_of(*format, channels) : std::nullopt;
    const double rate_hz = nearest_rate_hz(mode.rates_hz, wanted_hz);
    if (!rank || rate_hz < kSlowestShare * wanted_hz) continue;
    device::CameraSettings settings;
    settings.format = *format;
    settings.channels = channels;
    settings.size = mode.size;
    settings.rate_hz = rate_hz;
    const double pixels = static_cast<double>(mode.size.width_px) * mode.size.height_px;
    const bool is_slow = rate_hz < kSlow * wanted_hz;
    found.push_back({{is_slow, *rank, std::abs(std::log(pixels / usual_pixels(channels)))},
                     std::move(settings)});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Ranked& a, const Ranked& b) { return a.rank < b.rank; });
  std::vector<device::CameraSettings> settings;
  settings.reserve(found.size());
  for (Ranked& each : found) settings.push_back(std::move(each.settings));
  return settings;
}

bool is_monochrome(const std::vector<device::CameraMode>& modes) {
  const auto has = [&](device::Channels channels) {
    return std::any_of(modes.begin(), modes.end(), [&](const device::CameraMode& mode) {
      const auto format = device::pixel_format_of(mode.format);
      return format && rank_of(*format, channels);
    });
  };
  return has(device::Channels::kGrey) && !has(device::Channels::kRgb);
}

std::string text_of(const device::CameraSettings& settings) {
  return fmt::format("{}, {} x {} at {:.4g} Hz", device::to_string(settings.format),
                     settings.size.width_px, settings.size.height_px, settings.rate_hz);
}

}  // namespace flytri::setup
