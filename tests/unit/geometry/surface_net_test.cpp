#include "core/geometry/surface_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace flytri {
namespace {

/// Distance to a ball of radius 3 at the corners of a grid, without those farther away than `near`.
CornerValues ball_values(float near = 100.0F) {
  CornerValues grid;
  for (int z = -5; z <= 5; ++z)
    for (int y = -5; y <= 5; ++y)
      for (int x = -5; x <= 5; ++x) {
        const float value = std::sqrt(static_cast<float>(x * x + y * y + z * z)) - 3.1F;
        if (std::abs(value) > near) continue;
        grid.corners.push_back(grid_key(x, y, z));
        grid.values.push_back(value);
      }
  return grid;
}

std::vector<CellKey> crossed_cells(const CornerValues& grid) {
  CornerReader reader(grid);
  std::vector<CellKey> cells;
  for (const CellKey cell : grid.corners) {
    if (is_crossed(reader.around(cell))) cells.push_back(cell);
  }
  return cells;
}

std::vector<std::array<std::uint32_t, 4>> quads_of(const CornerValues& grid,
                                                   const std::vector<CellKey>& cells) {
  std::vector<std::array<std::uint32_t, 4>> quads;
  NetEdges edges(grid, cells);
  for (std::size_t i = 0; i < grid.corners.size(); ++i) {
    edges.from_corner(i, [&](const auto& ring) { quads.push_back(ring); });
  }
  return quads;
}

Vec3 middle_of(CellKey cell) {
  return Vec3(grid_number(cell, 0), grid_number(cell, 1), grid_number(cell, 2)).array() + 0.5;
}

TEST(SurfaceNet, CornersSortByZThenYThenX) {
  const CornerValues grid = ball_values();
  EXPECT_TRUE(std::is_sorted(grid.corners.begin(), grid.corners.end()));
  EXPECT_EQ(corner_of(grid_key(1, 2, 3), 5), grid_key(2, 2, 4));
}

TEST(SurfaceNet, ReadsTheCornersThatAreThere) {
  const CornerValues grid = ball_values();
  CornerReader reader(grid);
  const std::array<float, 8> values = reader.around(grid_key(0, 0, 2));
  EXPECT_FLOAT_EQ(values[0], 2.0F - 3.1F);
  EXPECT_FLOAT_EQ(values[4], 3.0F - 3.1F);
  EXPECT_TRUE(std::isnan(reader.around(grid_key(5, 0, 0))[1]));
}

TEST(SurfaceNet, ACrossingDividesAnEdgeAsTheValuesDo) {
  std::array<float, 8> values{};
  values.fill(1.0F);
  values[6] = -3.0F;
  EXPECT_TRUE(is_crossed(values));
  int count = 0;
  for_each_crossing(values, [&](int k, int l, double share) {
    ++count;
    EXPECT_TRUE(k == 6 || l == 6);
    EXPECT_DOUBLE_EQ(share, k == 6 ? 0.75 : 0.25);
  });
  EXPECT_EQ(count, 3);
}

TEST(SurfaceNet, TheNetOfABallIsClosedAndFacesOutwards) {
  const CornerValues grid = ball_values();
  const std::vector<CellKey> cells = crossed_cells(grid);
  const auto quads = quads_of(grid, cells);
  ASSERT_GT(quads.size(), 100U);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& ring : quads) {
    const Vec3 a = middle_of(cells[ring[0]]), b = middle_of(cells[ring[1]]),
               c = middle_of(cells[ring[2]]);
    EXPECT_GT((b - a).cross(c - a).dot(b), 0.0);
    for (std::size_t i = 0; i < 4; ++i) ++edges[{ring[i], ring[(i + 1) % 4]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(SurfaceNet, CornersFarFromTheSurfaceAreNotNeeded) {
  const CornerValues all = ball_values(), near = ball_values(2.0F);
  ASSERT_LT(near.corners.size(), all.corners.size());
  const std::vector<CellKey> cells = crossed_cells(all);
  EXPECT_EQ(crossed_cells(near), cells);
  EXPECT_EQ(quads_of(near, cells), quads_of(all, cells));
}

}  // namespace
}  // namespace flytri
