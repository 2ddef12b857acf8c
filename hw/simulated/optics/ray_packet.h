/// @file  Eight rays that are traced together (SIMD).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/geometry/rigid.h"

namespace flytri::simulated {

/// Rays from one origin, in any frame, and their hits. Single precision has an error of 0.01 µm at
/// the working distance of the intra-oral sensor.
struct RayPacket {
  static constexpr int kSize = 8;
  using Numbers = Eigen::Array<float, kSize, 1>;
  using Vectors = std::array<Numbers, 3>;  ///< x, y and z

  Vectors directions;  ///< unit
  // Result:
  Numbers distances_mm;  ///< infinite if nothing was hit
  Vectors normals;       ///< unit normals of the flat triangles, outwards
  std::array<std::uint32_t, kSize> triangles{};
  Numbers u, v;  ///< barycentric coordinates: weights of the second and third vertex

  /// Sets the rays. With fewer than eight, the last one is repeated, so that no value is undefined.
  void aim(std::span<const Vec3f> rays) {
    for (std::size_t i = 0; i < kSize; ++i)
      for (int axis = 0; axis < 3; ++axis)
        directions[axis][static_cast<Eigen::Index>(i)] = rays[std::min(i, rays.size() - 1)][axis];
  }
};

/// Rotates each of the vectors.
[[nodiscard]] inline RayPacket::Vectors rotated(const Eigen::Matrix3f& R,
                                                const RayPacket::Vectors& v) {
  const auto row = [&](int i) -> RayPacket::Numbers {
    return R(i, 0) * v[0] + R(i, 1) * v[1] + R(i, 2) * v[2];
  };
  return {row(0), row(1), row(2)};
}

}  // namespace flytri::simulated
