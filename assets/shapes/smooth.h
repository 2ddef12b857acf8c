/// @file  Smooth functions to compose organic shapes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/geometry/rigid.h"

namespace flytri::shapes {

/// The maximum, rounded where the values differ by less than `radius`.
[[nodiscard]] inline double smooth_max(double a, double b, double radius) {
  const double overlap = std::max(radius - std::abs(a - b), 0.0) / radius;
  return std::max(a, b) + 0.25 * overlap * overlap * radius;
}
[[nodiscard]] inline double smooth_min(double a, double b, double radius) {
  return -smooth_max(-a, -b, radius);
}

/// 0 below `low`, 1 above `high`, smooth between.
[[nodiscard]] inline double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// 1 at 0; decreases to 0 within about twice `width`.
[[nodiscard]] inline double bump(double x, double width) {
  const double t = x / width;
  return std::exp(-t * t);
}

/// Smooth noise in -1..1 with features of about one unit, the same for the same seed.
[[nodiscard]] double value_noise(const Vec3& p, std::uint64_t seed);

}  // namespace flytri::shapes
