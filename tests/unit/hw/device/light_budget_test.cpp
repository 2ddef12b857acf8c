#include "hw/device/light_budget.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "core/base/random.h"

namespace flytri::device {
namespace {

constexpr LightLimits kLimits = {{2.0, 0.6}, {2.0, 0.6}, {2.0, 0.25}};

struct OnTime {
  double begin_s = 0.0;
  double end_s = 0.0;
};

void turn(LightBudget& budget, Light light, double now_s) {
  budget.begin(light, now_s);
  budget.finish(light, now_s);
}

TEST(LightBudget, ALightThatStaysOnMustBeDarkAfterItsLongestTime) {
  LightBudget budget(kLimits);
  EXPECT_EQ(budget.dark_by_s(), std::numeric_limits<double>::infinity());
  turn(budget, Light::kFlash, 10.0);
  EXPECT_NEAR(budget.dark_by_s(), 12.0, 1e-9);
  turn(budget, Light::kDark, 11.0);
  EXPECT_EQ(budget.dark_by_s(), std::numeric_limits<double>::infinity());
}

TEST(LightBudget, RestsUntilTheDutyHoldsAfterALimit) {
  LightBudget budget(kLimits);
  turn(budget, Light::kFlash, 0.0);
  turn(budget, Light::kDark, 2.0);
  EXPECT_FALSE(budget.may_turn_on(Light::kFlash, 7.9));
  EXPECT_TRUE(budget.may_turn_on(Light::kVertical, 2.0)) << "each light has its own account";
  EXPECT_TRUE(budget.may_turn_on(Light::kFlash, 8.1));
}

TEST(LightBudget, BothLightsCountWhileACallChangesFromOneToTheOther) {
  LightBudget budget(kLimits);
  turn(budget, Light::kVertical, 0.0);
  budget.begin(Light::kHorizontal, 1.0);
  EXPECT_NEAR(budget.dark_by_s(), 2.0, 1e-9) << "vertical may still be on";
  budget.finish(Light::kHorizontal, 1.5);
  EXPECT_NEAR(budget.dark_by_s(), 3.0, 1e-9);
}

TEST(LightBudget, AProgramThatWasStoppedForLongDoesNotBlockTheLightForLong) {
  LightBudget budget(kLimits);
  turn(budget, Light::kFlash, 0.0);
  turn(budget, Light::kDark, 1000.0);
  EXPECT_FALSE(budget.may_turn_on(Light::kFlash, 1011.0));
  EXPECT_TRUE(budget.may_turn_on(Light::kFlash, 1012.1));
}

// The documented bound holds in every window, whatever is asked for.
TEST(LightBudget, NoRequestsExceedTheDutyInAnyWindow) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    Random random(seed);
    LightBudget budget(kLimits);
    std::vector<OnTime> on;
    double now_s = 0.0;
    while (now_s < 200.0) {
      const double wanted_s = now_s + random.uniform() * (seed % 2 == 0 ? 0.1 : 5.0);
      if (budget.may_turn_on(Light::kFlash, now_s)) {
        turn(budget, Light::kFlash, now_s);
        const double end_s = std::min(wanted_s, budget.dark_by_s());
        turn(budget, Light::kDark, end_s);
        on.push_back({now_s, end_s});
        now_s = end_s;
      }
      now_s += 0.002;
    }
    ASSERT_GT(on.size(), 5U);
    const LightLimit& limit = kLimits.flash;
    for (std::size_t first = 0; first < on.size(); ++first) {
      double lit_s = 0.0;
      for (std::size_t last = first; last < on.size(); ++last) {
        lit_s += on[last].end_s - on[last].begin_s;
        const double window_s = on[last].end_s - on[first].begin_s;
        ASSERT_LE(lit_s, limit.max_duty * window_s + (1.0 - limit.max_duty) * limit.max_on_s + 1e-6)
            << "seed " << seed;
      }
    }
  }
}

TEST(LightLimits, ReportsLimitsOutOfTheirRange) {
  EXPECT_TRUE(kLimits.validate());
  LightLimits limits = kLimits;
  limits.flash.max_duty = 0.98;
  EXPECT_THAT(limits.validate().error().message, ::testing::HasSubstr("max_duty"));
  limits = kLimits;
  limits.vertical.max_on_s = 0.0;
  EXPECT_THAT(limits.validate().error().message, ::testing::HasSubstr("max_on_s"));
}

}  // namespace
}  // namespace flytri::device
