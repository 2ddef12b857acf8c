#include "hw/sync/frame_clock.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace flytri::sync {
namespace {

constexpr double kPeriod_s = 0.04;

TEST(FrameClock, RemovesJitterFromStamps) {
  FrameClock clock({.period_s = kPeriod_s});
  Random random(1);
  double worst_s = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double true_s = 10.0 + i * kPeriod_s;
    const double stamp_s = clock.add(true_s + random.uniform(-0.005, 0.005));
    // Uniform jitter of ±5 ms has a standard deviation of 2.9 ms. At the end of a line fitted to 64
    // stamps, the uncertainty is 2 / sqrt(64) of it, 0.7 ms.
    if (i > 64) worst_s = std::max(worst_s, std::abs(stamp_s - true_s));
  }
  EXPECT_LT(worst_s, 0.0025);
}

TEST(FrameClock, LearnsThePeriodIfTheNominalOneIsWrong) {
  FrameClock clock({.period_s = 1.0 / 30.0});
  for (int i = 0; i < 40; ++i) clock.add(3.0 + i * kPeriod_s);
  EXPECT_NEAR(clock.period_s(), kPeriod_s, 1e-9);
  EXPECT_NEAR(clock.next_stamp_s(100.01), 100.04, 1e-6);
}

TEST(FrameClock, DroppedFramesDoNotChangeTheFit) {
  FrameClock clock({.period_s = kPeriod_s});
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    if (i > 8 && random.uniform() < 0.3) continue;
    EXPECT_NEAR(clock.add(i * kPeriod_s), i * kPeriod_s, 1e-9);
  }
}

TEST(FrameClock, AdaptsToARestartedCamera) {
  FrameClock clock({.period_s = kPeriod_s});
  for (int i = 0; i < 50; ++i) clock.add(i * kPeriod_s);
  for (int i = 0; i < 50; ++i) {
    const double stamp_s = 2.02 + i * kPeriod_s;
    const double steady_s = clock.add(stamp_s);
    EXPECT_NEAR(steady_s, stamp_s, i > 16 ? 1e-6 : 0.5 * kPeriod_s);
  }
}

TEST(FrameClock, NeverMovesAStampFarOrBackwards) {
  FrameClock clock({.period_s = kPeriod_s, .max_correction = 0.25});
  Random random(3);
  double stamp_s = 0.0, before_s = -1.0;
  for (int i = 0; i < 300; ++i) {
    stamp_s += random.uniform(0.2, 2.0) * kPeriod_s;
    const double steady_s = clock.add(stamp_s);
    EXPECT_GT(steady_s, before_s);
    EXPECT_LT(std::abs(steady_s - stamp_s), 0.26 * 2.0 * kPeriod_s);
    before_s = steady_s;
  }
}

TEST(FrameClock, RefusesBadOptions) {
  EXPECT_FALSE(FrameClockOptions{.period_s = 0.0}.validate());
  EXPECT_FALSE(FrameClockOptions{.memory = 2}.validate());
  EXPECT_FALSE(FrameClockOptions{.max_correction = 0.6}.validate());
}

}  // namespace
}  // namespace flytri::sync
