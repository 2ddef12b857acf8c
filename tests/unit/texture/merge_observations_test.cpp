#include "core/texture/merge_observations.h"

#include <gtest/gtest.h>

#include <vector>

namespace flytri::texture {
namespace {

Vec3f merge(std::vector<Observation> seen) { return merge_observations(seen); }

TEST(MergeObservations, AveragesThoseThatAgreeByTheirWeights) {
  EXPECT_EQ(merge({{{0.4F, 0.3F, 0.2F}, 0.7F}}), Vec3f(0.4F, 0.3F, 0.2F));
  const Vec3f merged = merge({{{0.40F, 0.3F, 0.2F}, 3.0F}, {{0.41F, 0.3F, 0.2F}, 1.0F}});
  EXPECT_NEAR(merged.x(), 0.4025F, 2e-4F);
  EXPECT_NEAR(merged.y(), 0.3F, 1e-6F);
}

TEST(MergeObservations, AHighlightGivesWay) {
  // Seen straight from where the camera sees best, it has the larger weight.
  const Vec3f merged = merge({{{0.9F, 0.85F, 0.8F}, 1.0F}, {{0.4F, 0.3F, 0.2F}, 0.6F}});
  EXPECT_NEAR(merged.x(), 0.4F, 0.03F);
  EXPECT_NEAR(merged.z(), 0.2F, 0.03F);
}

TEST(MergeObservations, AShadowGivesWayToTwoThatAgree) {
  const Vec3f merged = merge(
      {{{0.1F, 0.08F, 0.05F}, 1.0F}, {{0.40F, 0.3F, 0.2F}, 1.0F}, {{0.41F, 0.3F, 0.2F}, 1.0F}});
  EXPECT_NEAR(merged.x(), 0.4F, 0.02F);
}

TEST(MergeObservations, DoesNotDependOnTheOrderOfTheFrames) {
  const Observation a{{0.5F, 0.4F, 0.3F}, 0.5F}, b{{0.45F, 0.38F, 0.3F}, 0.8F},
      c{{0.48F, 0.4F, 0.31F}, 0.2F};
  EXPECT_LT((merge({a, b, c}) - merge({c, a, b})).norm(), 1e-6F);
}

}  // namespace
}  // namespace flytri::texture
