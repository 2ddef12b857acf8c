#include "ui/scene/detail_governor.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

/// A machine that takes a fixed time for a picture and more for each surfel.
double picture_ms(double surfels) { return 10.0 + 2e-4 * surfels; }

TEST(DetailGovernor, ReachesTheTimeAimedAt) {
  DetailGovernor governor;
  constexpr std::size_t kVisible = 2'000'000;
  double drawn = 0.0;
  for (int frame = 0; frame < 30; ++frame) {
    drawn = governor.share_for(kVisible, 33.0) * kVisible;
    governor.learn(static_cast<std::size_t>(drawn), picture_ms(drawn));
  }
  // A third less or a tenth more is tolerated.
  EXPECT_GT(picture_ms(drawn), 0.67 * 33.0);
  EXPECT_LT(picture_ms(drawn), 1.1 * 33.0);
}

TEST(DetailGovernor, DrawsEverythingIfThereIsTime) {
  DetailGovernor governor;
  for (int frame = 0; frame < 10; ++frame) {
    EXPECT_EQ(governor.share_for(60'000, 33.0), 1.0);
    governor.learn(60'000, picture_ms(60'000));
  }
}

TEST(DetailGovernor, SmallVariationsInTimeDoNotChangeTheShare) {
  DetailGovernor governor;
  governor.learn(200'000, 50.0);
  const double share = governor.share_for(1'000'000, 33.0);
  for (const double ms : {31.0, 34.0, 35.0, 30.0, 33.0}) {
    governor.learn(static_cast<std::size_t>(share * 1e6), ms);
    EXPECT_EQ(governor.share_for(1'000'000, 33.0), share);
  }
}

TEST(DetailGovernor, KeepsTheShapeOnASlowMachine) {
  DetailGovernor governor;
  governor.learn(100'000, 1000.0);
  EXPECT_EQ(governor.share_for(1'000'000, 33.0), 0.05) << "50 000 surfels at least";
}

}  // namespace
}  // namespace flytri::ui
