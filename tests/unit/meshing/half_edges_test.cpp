#include "core/meshing/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/base/random.h"

namespace flytri::meshing {
namespace {

TEST(HalfEdges, AreTheSortedEdgesOfTheTriangles) {
  constexpr std::uint32_t kVertices = 30;
  Random random(5);
  TriangleMesh mesh;
  mesh.vertices.resize(kVertices);
  for (int t = 0; t < 200; ++t) {
    Triangle triangle;
    for (std::uint32_t& v : triangle) v = static_cast<std::uint32_t>(random.below(kVertices));
    mesh.triangles.push_back(triangle);
  }
  const std::vector<HalfEdge> edges = half_edges_of(mesh);
  ASSERT_EQ(edges.size(), 3 * mesh.triangles.size());
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.low, a.high, a.corner) < std::tuple(b.low, b.high, b.corner);
  }));
  std::vector<int> seen(edges.size(), 0);
  for (const HalfEdge& edge : edges) {
    ++seen[edge.corner];
    const Triangle& triangle = mesh.triangles[edge.triangle()];
    const std::uint32_t from = triangle[edge.corner % 3];
    const std::uint32_t to = triangle[(edge.corner + 1) % 3];
    EXPECT_EQ(edge.low, std::min(from, to));
    EXPECT_EQ(edge.high, std::max(from, to));
    EXPECT_EQ(edge.rising, from < to);
  }
  EXPECT_EQ(seen, std::vector<int>(edges.size(), 1));
}

}  // namespace
}  // namespace flytri::meshing
