#include "core/registration/closest_pair.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace flytri::registration {
namespace {

/// A random walk through space: it comes close to itself, so that the search has many minima.
PreparedProfile random_profile(std::size_t knots, double roughness, Random& random) {
  std::vector<double> parameters;
  std::vector<Vec3> points;
  Vec3 p = 2.0 * Vec3(random.normal(), random.normal(), random.normal());
  Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
  for (std::size_t i = 0; i < knots; ++i) {
    parameters.push_back(static_cast<double>(i));
    points.push_back(p);
    direction += roughness * Vec3(random.normal(), random.normal(), random.normal());
    direction.normalize();
    p += 0.05 * direction;
  }
  PreparedProfile profile;
  profile.curve = CubicCurve(parameters, points);
  profile.tree = BoxTree(profile.curve);
  return profile;
}

TEST(ClosestPair, HierarchicalSearchEqualsBruteForce) {
  Random random(7);
  int found = 0;
  for (int run = 0; run < 600; ++run) {
    const double roughness = random.uniform(0.0, 0.8);
    const auto first = random_profile(2 + random.below(150), roughness, random);
    const auto second = random_profile(2 + random.below(150), roughness, random);
    const double limit_mm = random.uniform(0.05, 6.0);
    const auto expected = closest_knots_brute_force(first.curve, second.curve, limit_mm);
    const auto actual = closest_knots(first, second, limit_mm);
    ASSERT_EQ(actual.has_value(), expected.has_value());
    if (!expected) continue;
    ++found;
    EXPECT_EQ(actual->k, expected->k);
    EXPECT_EQ(actual->l, expected->l);
    EXPECT_EQ(actual->squared_distance_mm2, expected->squared_distance_mm2);
  }
  EXPECT_GT(found, 100);
}

TEST(ClosestPair, EqualDistancesGiveTheFirstPairInBothSearches) {
  std::vector<double> parameters;
  std::vector<Vec3> along_x, above;
  for (int i = 0; i < 40; ++i) {
    parameters.push_back(i);
    along_x.emplace_back(i, 0, 0);
    above.emplace_back(i, 0, 1);
  }
  PreparedProfile first, second;
  first.curve = CubicCurve(parameters, along_x);
  second.curve = CubicCurve(parameters, above);
  first.tree = BoxTree(first.curve);
  second.tree = BoxTree(second.curve);
  const auto pair = closest_knots(first, second, 2.0);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->k, 0U);
  EXPECT_EQ(pair->l, 0U);
}

TEST(ClosestPair, RefinementFindsTheCrossingBetweenKnots) {
  std::vector<double> parameters;
  std::vector<Vec3> along_x, along_y;
  for (int i = 0; i < 30; ++i) {
    parameters.push_back(i);
    along_x.emplace_back(0.1 * i, 1.234, 0.0);
    along_y.emplace_back(0.777, 0.1 * i, 0.02);
  }
  const CubicCurve first(parameters, along_x), second(parameters, along_y);
  const CurvePair pair = refine_on_curves(first, second, Isometry::Identity(), 9, 10);
  EXPECT_TRUE(pair.inside);
  EXPECT_NEAR(pair.x, 7.77, 1e-3);
  EXPECT_NEAR(pair.y, 12.34, 1e-3);
  EXPECT_NEAR((pair.p.position_mm - pair.q.position_mm).norm(), 0.02, 1e-6);
}

TEST(ClosestPair, EndsAreNotCrossings) {
  const std::vector<double> parameters = {0, 1, 2};
  const std::vector<Vec3> along_x = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const std::vector<Vec3> along_y = {{0, -1, 0}, {0, 0, 0}, {0, 1, 0}};
  const CubicCurve first(parameters, along_x), second(parameters, along_y);
  EXPECT_FALSE(refine_on_curves(first, second, Isometry::Identity(), 0, 1).inside);
}

}  // namespace
}  // namespace flytri::registration
