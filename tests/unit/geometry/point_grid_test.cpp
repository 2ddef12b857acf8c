#include "core/geometry/point_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/base/random.h"

namespace flytri {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Vec3f> random_points(std::size_t count, double extent_mm) {
  Random random(7);
  std::vector<Vec3f> points(count);
  for (Vec3f& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = static_cast<float>(random.uniform(-extent_mm, extent_mm));
    }
  }
  return points;
}

/// Brute force: all points within the radius, nearest first.
std::vector<Neighbor> brute_force(const std::vector<Vec3f>& points, const Vec3f& center,
                                  float radius) {
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float distance2 = (points[i] - center).squaredNorm();
    if (distance2 <= radius * radius) found.push_back({static_cast<std::uint32_t>(i), distance2});
  }
  std::sort(found.begin(), found.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.distance2_mm2 != b.distance2_mm2 ? a.distance2_mm2 < b.distance2_mm2
                                              : a.index < b.index;
  });
  return found;
}

std::vector<std::uint32_t> indices(const std::vector<Neighbor>& neighbors) {
  std::vector<std::uint32_t> result;
  for (const Neighbor& n : neighbors) result.push_back(n.index);
  return result;
}

/// Search radius relative to the cell: smaller, equal, larger.
class PointGridRadius : public ::testing::TestWithParam<float> {};

TEST_P(PointGridRadius, FindsTheSamePointsAsBruteForce) {
  const std::vector<Vec3f> points = random_points(3000, 2.0);
  const PointGrid grid(points, 0.3F);
  std::vector<Neighbor> found;
  for (const Vec3f& center : random_points(200, 2.5)) {
    const float radius = 0.3F * GetParam();
    const std::vector<Neighbor> expected = brute_force(points, center, radius);
    grid.within(center, radius, found);
    std::vector<std::uint32_t> sorted = indices(found);
    std::vector<std::uint32_t> expected_sorted = indices(expected);
    std::sort(sorted.begin(), sorted.end());
    std::sort(expected_sorted.begin(), expected_sorted.end());
    EXPECT_EQ(sorted, expected_sorted);

    grid.nearest(center, 5, radius, found);
    const std::size_t count = std::min<std::size_t>(5, expected.size());
    EXPECT_EQ(indices(found), indices({expected.begin(), expected.begin() + count}));

    const auto nearest = grid.nearest(center, radius);
    ASSERT_EQ(nearest.has_value(), !expected.empty());
    if (nearest) {
      EXPECT_EQ(nearest->index, expected.front().index);
    }
  }
}

TEST_P(PointGridRadius, AWalkFindsWhatSingleSearchesFind) {
  const std::vector<Vec3f> points = random_points(3000, 2.0);
  const PointGrid grid(points, 0.3F);
  PointWalk walk(grid);
  const float radius = 0.3F * GetParam();
  std::vector<Neighbor> expected;
  Vec3f center(-2.5F, 0.0F, 0.0F);
  const std::vector<Vec3f> jumps = random_points(40, 2.5);
  for (int step = 0; step < 2000; ++step) {
    // Small steps forth and back, and now and then to another place.
    center += 0.02F * Vec3f(std::sin(0.1F * static_cast<float>(step)) + 0.2F, 0.3F, -0.1F);
    if (step % 50 == 49) center = jumps[static_cast<std::size_t>(step / 50)];
    grid.within(center, radius, expected);
    const std::span<const Neighbor> found = walk.within(center, radius);
    ASSERT_EQ(indices({found.begin(), found.end()}), indices(expected)) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, PointGridRadius, ::testing::Values(0.4F, 1.0F, 3.7F));

TEST(PointGrid, FindsAllEqualPointsAndReturnsTheFirstAsNearest) {
  const std::vector<Vec3f> points(3, Vec3f(1, 2, 3));
  const PointGrid grid(points, 1.0F);
  std::vector<Neighbor> found;
  grid.within(Vec3f(1, 2, 3), 0.0F, found);
  EXPECT_THAT(indices(found), ElementsAre(0, 1, 2));
  EXPECT_EQ(grid.nearest(Vec3f(1, 2, 4), 2.0F)->index, 0U);
}

TEST(PointGrid, NothingIsFoundInAnEmptyGridOrTooFarAway) {
  std::vector<Neighbor> found = {{1, 1.0F}};
  const PointGrid empty({}, 1.0F);
  empty.within(Vec3f::Zero(), 10.0F, found);
  EXPECT_THAT(found, IsEmpty());
  EXPECT_FALSE(empty.nearest(Vec3f::Zero(), 10.0F).has_value());
  const std::vector<Vec3f> one = {Vec3f(5, 0, 0)};
  EXPECT_FALSE(PointGrid(one, 1.0F).nearest(Vec3f::Zero(), 4.9F).has_value());
}

}  // namespace
}  // namespace flytri
