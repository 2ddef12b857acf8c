/// @file  Enumerates the texels that a triangle covers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/rigid.h"

namespace flytri::texture {

/// Calls visit(x, y, weights) for every texel whose center (x + 0.5, y + 0.5) lies inside the
/// triangle, with the barycentric weights of its corners. Centers on an edge are skipped, because
/// they would belong to two triangles.
template <typename Visit>
void for_each_texel(const std::array<Eigen::Array2f, 3>& corners, const Visit& visit) {
  const Eigen::Array2f low = corners[0].min(corners[1]).min(corners[2]);
  const Eigen::Array2f high = corners[0].max(corners[1]).max(corners[2]);
  const auto cross = [](const Eigen::Array2f& a, const Eigen::Array2f& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const float area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (area == 0.0F) return;
  const Eigen::Array2i first = (low - 0.5F).ceil().cast<int>();
  const Eigen::Array2i last = (high - 0.5F).floor().cast<int>();
  for (int y = first.y(); y <= last.y(); ++y) {
    for (int x = first.x(); x <= last.x(); ++x) {
      const Eigen::Array2f p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float a = cross(corners[1] - p, corners[2] - p) / area;
      const float b = cross(corners[2] - p, corners[0] - p) / area;
      const float c = cross(corners[0] - p, corners[1] - p) / area;
      if (a > 0.0F && b > 0.0F && c > 0.0F) visit(x, y, Vec3f(a, b, c));
    }
  }
}

}  // namespace flytri::texture
