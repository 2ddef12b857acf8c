#include "core/geometry/sphere_mesh.h"

#include <cmath>
#include <numbers>

namespace flytri {

TriangleMesh sphere_mesh(const Vec3& center_mm, double radius_mm, int rings) {
  const auto row_count = static_cast<std::uint32_t>(rings);
  const std::uint32_t around = 2 * row_count;
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row <= row_count; ++row) {
    const double polar = std::numbers::pi * row / rings;
    for (std::uint32_t i = 0; i < around; ++i) {
      const double turn = std::numbers::pi * i / rings;
      const Vec3 normal(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                        std::cos(polar));
      SurfacePoint vertex;
      vertex.position_mm = (center_mm + radius_mm * normal).cast<float>();
      vertex.normal = normal.cast<float>();
      mesh.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t row = 0; row < row_count; ++row) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = row * around + i, b = row * around + (i + 1) % around;
      // At a pole all vertices of the row are one point.
      if (row + 1 < row_count) mesh.triangles.push_back({a, a + around, b + around});
      if (row > 0) mesh.triangles.push_back({a, b + around, b});
    }
  }
  return mesh;
}

}  // namespace flytri
