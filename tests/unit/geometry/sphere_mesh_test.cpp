#include "core/geometry/sphere_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace flytri {
namespace {

TEST(SphereMesh, IsClosedFacesOutwardsAndHasItsVolume) {
  const Vec3 center_mm(5.0, -2.0, 1.0);
  const TriangleMesh mesh = sphere_mesh(center_mm, 3.0, 40);
  double volume_mm3 = 0.0;
  // By its ends: how often an edge is passed in this direction. A pole is one point.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passes;
  const auto name = [](std::uint32_t vertex) {
    if (vertex < 80) return 0U;
    return vertex >= 40 * 80 ? 40U * 80U : vertex;
  };
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](int i) -> Vec3 {
      return mesh.vertices[t[i]].position_mm.cast<double>() - center_mm;
    };
    volume_mm3 += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
    for (int i = 0; i < 3; ++i) ++passes[{name(t[i]), name(t[(i + 1) % 3])}];
  }
  EXPECT_NEAR(volume_mm3, 4.0 / 3.0 * std::numbers::pi * 27.0, 0.5);
  for (const auto& [edge, count] : passes) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(passes.contains({edge.second, edge.first}));
  }
}

}  // namespace
}  // namespace flytri
