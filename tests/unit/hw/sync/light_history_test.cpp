#include "hw/sync/light_history.h"

#include <gtest/gtest.h>

namespace flytri::sync {
namespace {

device::LightSwitching switching(std::int64_t request, device::Light light, double before_s,
                                 double after_s) {
  return {request, light, before_s, after_s, true};
}

TEST(LightHistory, StartsDark) {
  const LightTimes times = LightHistory().times(1.0, 3.0);
  EXPECT_DOUBLE_EQ(times.lit(device::Light::kDark), 2.0);
  EXPECT_DOUBLE_EQ(times.changing_s, 0.0);
}

TEST(LightHistory, DividesTimeBetweenLightsAndDeviceCalls) {
  LightHistory history;
  history.switched(switching(1, device::Light::kVertical, 1.0, 1.25));
  history.switched(switching(2, device::Light::kHorizontal, 2.0, 2.5));
  const LightTimes times = history.times(0.5, 4.0);
  EXPECT_DOUBLE_EQ(times.lit(device::Light::kDark), 0.5);
  EXPECT_DOUBLE_EQ(times.lit(device::Light::kVertical), 0.75);
  EXPECT_DOUBLE_EQ(times.lit(device::Light::kHorizontal), 1.5);
  EXPECT_DOUBLE_EQ(times.changing_s, 0.75);
}

TEST(LightHistory, LightIsUnknownFromDueTimeUntilTheRequestIsDone) {
  LightHistory history;
  history.switched(switching(1, device::Light::kVertical, 0.0, 0.0));
  history.posted(2, 5.0);
  EXPECT_DOUBLE_EQ(history.times(4.0, 7.0).changing_s, 2.0);
  EXPECT_DOUBLE_EQ(history.times(6.0, 7.0).changing_s, 1.0);
  history.switched(switching(2, device::Light::kFlash, 5.5, 5.75));
  const LightTimes times = history.times(4.0, 7.0);
  EXPECT_DOUBLE_EQ(times.lit(device::Light::kVertical), 1.5);
  EXPECT_DOUBLE_EQ(times.changing_s, 0.25);
  EXPECT_DOUBLE_EQ(times.lit(device::Light::kFlash), 1.25);
}

TEST(LightHistory, IgnoresRefusedAndSkippedRequests) {
  LightHistory history;
  history.posted(1, 1.0);
  history.posted(2, 2.0);
  device::LightSwitching refused = switching(2, device::Light::kVertical, 2.0, 2.1);
  refused.accepted = false;
  history.switched(refused);
  const LightTimes times = history.times(0.0, 3.0);
  EXPECT_DOUBLE_EQ(times.lit(device::Light::kDark), 3.0);
}

TEST(LightHistory, RunningTimesAddUp) {
  LightHistory history;
  history.switched(switching(1, device::Light::kVertical, 0.3, 0.4));
  const auto sums = history.running_times(0.0, 0.1, 10);
  ASSERT_EQ(sums.size(), 11U);
  EXPECT_NEAR(sums.back().lit(device::Light::kVertical), 0.6, 1e-12);
  EXPECT_NEAR(sums.back().changing_s, 0.1, 1e-12);
  EXPECT_NEAR(sums[3].lit(device::Light::kDark), 0.3, 1e-12);
}

}  // namespace
}  // namespace flytri::sync
