/// @file  Eight rays at once, in the numbers that a processor handles at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/geometry/rigid.h"

namespace flytri::simulated {

/// Rays from one place, in any frame, and what they met. Single precision: 0.01 um at the distance
/// of a sensor for teeth.
struct RayPacket {
  static constexpr int kSize = 8;
  using Numbers = Eigen::Array<float, kSize, 1>;
  using Vectors = std::array<Numbers, 3>;  ///< x, y and z

  Vectors directions;  ///< unit
  // The answer:
  Numbers distances_mm;  ///< infinite where nothing was met
  Vectors normals;       ///< unit, of the flat triangle, outwards
  std::array<std::uint32_t, kSize> triangles{};
  Numbers u, v;  ///< barycentric, of the triangle's second and third vertex

  /// Sets the rays; those beyond `rays` repeat its last, so that nothing is ever undefined.
  void aim(std::span<const Vec3f> rays) {
    for (std::size_t i = 0; i < kSize; ++i)
      for (int axis = 0; axis < 3; ++axis)
        directions[axis][static_cast<Eigen::Index>(i)] = rays[std::min(i, rays.size() - 1)][axis];
  }
};

/// Each of the vectors, rotated.
[[nodiscard]] inline RayPacket::Vectors rotated(const Eigen::Matrix3f& R,
                                                const RayPacket::Vectors& v) {
  const auto row = [&](int i) -> RayPacket::Numbers {
    return R(i, 0) * v[0] + R(i, 1) * v[1] + R(i, 2) * v[2];
  };
  return {row(0), row(1), row(2)};
}

}  // namespace flytri::simulated
