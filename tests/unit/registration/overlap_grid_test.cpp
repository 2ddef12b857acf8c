#include "core/registration/overlap_grid.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace flytri::registration {
namespace {

ViewExtent extent_at(const Vec3& center_mm, const Vec3& direction) {
  return {center_mm, direction, Vec3::UnitZ(), 7.0};
}

TEST(OverlapGrid, FindsTheSameViewsAsBruteForce) {
  Random random(1);
  OverlapGrid grid(5.0);
  for (int i = 0; i < 300; ++i) {
    const Vec3 center = 30.0 * Vec3(random.normal(), random.normal(), random.normal());
    grid.add(extent_at(center, i % 2 == 0 ? Vec3::UnitX() : Vec3::UnitY()));
  }
  const ViewExtent around = extent_at(Vec3(1, 2, 3), Vec3::UnitX());
  std::vector<std::size_t> expected, actual;
  for (std::size_t i = 1; i < grid.size(); i += 2) {  // the half with crossed lines
    if ((grid.extent(i).center_mm - around.center_mm).norm() < 2.4 * 7.0) expected.push_back(i);
  }
  for (const Overlap& overlap : grid.overlapping(around)) actual.push_back(overlap.view);
  EXPECT_EQ(actual, expected);
  EXPECT_FALSE(expected.empty());
}

TEST(OverlapGrid, PrefersNearAndCrossedViewsAndTheSameSide) {
  OverlapGrid grid(7.0);
  grid.add(extent_at(Vec3(0, 0, 0), Vec3::UnitY()));
  grid.add(extent_at(Vec3(8, 0, 0), Vec3::UnitY()));
  grid.add(extent_at(Vec3(0, 0, 0), Vec3(1, 1, 0).normalized()));
  ViewExtent behind = extent_at(Vec3(0, 0, 0), Vec3::UnitY());
  behind.sight = -Vec3::UnitZ();
  grid.add(behind);
  const auto found = grid.overlapping(extent_at(Vec3(0, 0, 0), Vec3::UnitX()));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_DOUBLE_EQ(found[0].worth, 1.0);
  EXPECT_LT(found[1].worth, found[0].worth);
  EXPECT_NEAR(found[2].worth, 0.5, 1e-12);
}

TEST(OverlapGrid, FollowsAMovedView) {
  OverlapGrid grid(7.0);
  grid.add(extent_at(Vec3(100, 0, 0), Vec3::UnitY()));
  const ViewExtent around = extent_at(Vec3(0, 0, 0), Vec3::UnitX());
  EXPECT_TRUE(grid.overlapping(around).empty());
  grid.move(0, extent_at(Vec3(1, 0, 0), Vec3::UnitY()));
  EXPECT_EQ(grid.overlapping(around).size(), 1U);
}

}  // namespace
}  // namespace flytri::registration
