#include "core/meshing/mesh_topology.h"

#include <gtest/gtest.h>

namespace flytri::meshing {
namespace {

constexpr std::uint32_t kCells = 20;

/// A hole in the shape of a comb: its boundary is three times as long as the border of the square
/// around it.
bool is_in_comb(std::uint32_t column, std::uint32_t row) {
  const bool is_spine = row == 2 && column >= 2 && column < 18;
  const bool is_tooth = column % 2 == 0 && column >= 2 && column < 18 && row >= 3 && row < 17;
  return is_spine || is_tooth;
}

/// A square in the plane z = 0, seen from above, with cells of 1 mm.
TriangleMesh square_without(bool (*is_cut_out)(std::uint32_t column, std::uint32_t row)) {
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row <= kCells; ++row) {
    for (std::uint32_t column = 0; column <= kCells; ++column) {
      SurfacePoint& vertex = mesh.vertices.emplace_back();
      vertex.position_mm = Vec3f(static_cast<float>(column), static_cast<float>(row), 0.0F);
      vertex.normal = Vec3f::UnitZ();
    }
  }
  for (std::uint32_t row = 0; row < kCells; ++row) {
    for (std::uint32_t column = 0; column < kCells; ++column) {
      if (is_cut_out(column, row)) continue;
      const std::uint32_t v = row * (kCells + 1) + column, above = v + kCells + 1;
      mesh.triangles.push_back({v, v + 1, above + 1});
      mesh.triangles.push_back({v, above + 1, above});
    }
  }
  repair_manifold(mesh);
  return mesh;
}

TEST(FindBoundaries, TheLoopWithTheLargestAreaIsTheBorderEvenIfAHoleIsLonger) {
  const std::vector<BoundaryLoop> loops = find_boundaries(square_without(is_in_comb));
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_TRUE(loops[0].is_outer);
  EXPECT_NEAR(loops[0].area_mm2, 400.0, 1e-3);
  EXPECT_FALSE(loops[1].is_outer);
  EXPECT_NEAR(loops[1].area_mm2, 128.0, 1e-3);
  EXPECT_GT(loops[1].perimeter_mm, 3.0 * loops[0].perimeter_mm);
  EXPECT_NEAR(loops[1].width_mm, 1.25, 0.1)
      << "where a tooth of the comb meets its spine; both are one cell wide";
}

TEST(FindBoundaries, AHoleAroundAComponentIsAsWideAsTheGapBetweenThem) {
  const auto is_in_ring = [](std::uint32_t column, std::uint32_t row) {
    const bool is_within = column >= 4 && column < 16 && row >= 4 && row < 16;
    const bool is_piece = column >= 6 && column < 15 && row >= 5 && row < 15;
    return is_within && !is_piece;
  };
  const std::vector<BoundaryLoop> loops = find_boundaries(square_without(is_in_ring));
  ASSERT_EQ(loops.size(), 3U);
  EXPECT_FALSE(loops[1].is_outer);
  EXPECT_NEAR(loops[1].area_mm2, 144.0, 1e-3);
  EXPECT_NEAR(loops[1].width_mm, 2.0, 0.1);
  EXPECT_NEAR(loops[1].center_mm.x(), 5.0F, 0.1F);
  EXPECT_GT(loops[1].normal.z(), 0.999F);
  EXPECT_TRUE(loops[2].is_outer);
}

TEST(FindBoundaries, AHoleWithoutAreaHasNoWidth) {
  const auto is_in_cell = [](std::uint32_t column, std::uint32_t row) {
    return column == 10 && row == 10;
  };
  TriangleMesh mesh = square_without(is_in_cell);
  for (const std::uint32_t row : {10U, 11U}) {
    const std::uint32_t left = row * (kCells + 1) + 10;
    mesh.vertices[left + 1].position_mm = mesh.vertices[left].position_mm;
  }
  repair_manifold(mesh);
  const std::vector<BoundaryLoop> loops = find_boundaries(mesh);
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[1].area_mm2, 0.0);
  EXPECT_EQ(loops[1].width_mm, 0.0);
  EXPECT_NEAR(loops[1].center_mm.x(), 10.0F, 1e-3F);
}

}  // namespace
}  // namespace flytri::meshing
