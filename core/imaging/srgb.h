/// @file  Converts sRGB to the linear vertex colors of glTF, and back.
#pragma once

#include <cmath>
#include <cstdint>

namespace flytri {

/// @source  IEC 61966-2-1, as a 16-bit share of full brightness. Neighboring sRGB values differ by
///          at least 20.
[[nodiscard]] inline std::uint16_t to_linear(std::uint8_t srgb) {
  const double value = srgb / 255.0;
  const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(65535.0 * linear));
}

/// Inverse of to_linear.
[[nodiscard]] inline std::uint8_t to_srgb(std::uint16_t light) {
  const double linear = light / 65535.0;
  const double value =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * value));
}

}  // namespace flytri
