#include "hw/simulated/devices/faulty_sensor.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/manual_clock.h"
#include "tests/support/scripted_sensor.h"

namespace flytri::simulated {
namespace {

using testing::ManualClock;
using testing::ScriptedSensor;

constexpr int kFrames = 1000;

std::shared_ptr<FaultySensor> make_sensor(const FaultOptions& options, const ManualClock& clock) {
  std::deque<ScriptedSensor::Step> script;
  for (int i = 0; i < kFrames; ++i) script.push_back(ScriptedSensor::frame(i, i / 30.0));
  return FaultySensor::create(std::make_shared<ScriptedSensor>(std::move(script)), options,
                              clock.clock())
      .value();
}

struct Pass {
  std::vector<int> indices;
  int unknown = 0, lost_calls = 0;
};
Pass run(FaultySensor& sensor) {
  Pass result;
  EXPECT_TRUE(sensor.start());
  for (;;) {
    const auto frame = sensor.next(0.05);
    const device::SensorState state = sensor.status().state;
    if (!frame || state == device::SensorState::kEnded) return result;
    result.lost_calls += state == device::SensorState::kLost ? 1 : 0;
    if (!*frame) continue;
    result.indices.push_back((*frame)->index.value);
    result.unknown += (*frame)->kind == FrameKind::kUnknown ? 1 : 0;
  }
}

TEST(FaultySensor, DropsFramesAndHidesPatternsAtTheGivenRates) {
  const ManualClock clock;
  const auto sensor = make_sensor({.dropped_share = 0.2, .unknown_share = 0.5}, clock);
  const Pass result = run(*sensor);
  // Tolerances: four standard deviations of a binomial count.
  EXPECT_NEAR(static_cast<double>(result.indices.size()), 800.0, 51.0);
  EXPECT_NEAR(result.unknown, 0.5 * static_cast<double>(result.indices.size()), 57.0);
  EXPECT_EQ(sensor->status().delivered + sensor->status().dropped, kFrames);
}

TEST(FaultySensor, DelayedFramesArriveInOrderWithoutLoss) {
  const ManualClock clock;
  const auto sensor = make_sensor({.delayed_share = 0.3, .max_delay_s = 0.2}, clock);
  const Pass result = run(*sensor);
  ASSERT_EQ(result.indices.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) EXPECT_EQ(result.indices[i], i);
  // About 300 delays of 0.1 s on average.
  EXPECT_NEAR(clock.now_s() - 100.0, 30.0, 8.0);
}

TEST(FaultySensor, DisconnectsAndReconnects) {
  const ManualClock clock;
  const auto sensor = make_sensor({.lost_share = 0.02, .max_lost_frames = 10}, clock);
  const Pass result = run(*sensor);
  EXPECT_GT(result.lost_calls, 20);
  EXPECT_GT(result.indices.size(), 700U);
  EXPECT_EQ(sensor->status().delivered + sensor->status().dropped, kFrames);
}

TEST(FaultySensor, FailsUntilItIsRestarted) {
  const ManualClock clock;
  const auto sensor = make_sensor({.fails_after = 7}, clock);
  EXPECT_EQ(run(*sensor).indices.size(), 7U);
  EXPECT_EQ(sensor->status().state, device::SensorState::kFailed);
  EXPECT_FALSE(sensor->status().message.empty());
  EXPECT_EQ(run(*sensor).indices.size(), 7U);
}

TEST(FaultySensor, FaultsDependOnTheSeed) {
  const ManualClock clock;
  const FaultOptions options{.dropped_share = 0.3, .lost_share = 0.01};
  FaultOptions other = options;
  other.seed = 2;
  const auto first = run(*make_sensor(options, clock)).indices;
  EXPECT_EQ(first, run(*make_sensor(options, clock)).indices);
  EXPECT_NE(first, run(*make_sensor(other, clock)).indices);
}

}  // namespace
}  // namespace flytri::simulated
