/// @file  Converts between sRGB bytes and linear light.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace flytri::texture {

/// Linear light 0..1 of an sRGB value 0..255.
/// @source  IEC 61966-2-1.
[[nodiscard]] inline float linear_from_srgb(float value) {
  const float v = value / 255.0F;
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

/// The nearest sRGB byte of linear light, clamped to 0..1.
[[nodiscard]] inline std::uint8_t srgb_from_linear(float light) {
  const float l = std::clamp(light, 0.0F, 1.0F);
  const float v = l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * v));
}

}  // namespace flytri::texture
