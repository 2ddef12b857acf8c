#include "hw/device/capture_loop.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>
#include <vector>

#include "tests/support/scripted_sensor.h"

namespace flytri::device {
namespace {

using testing::ScriptedSensor;
using Script = std::deque<ScriptedSensor::Step>;

// Waits until the loop's thread has reached a state.
void wait_for(const CaptureLoop& loop, SensorState state) {
  while (loop.status().state != state) std::this_thread::yield();
}

TEST(CaptureLoop, PassesOnEveryFrameInOrder) {
  Script script;
  for (int i = 0; i < 100; ++i) script.push_back(ScriptedSensor::frame(i, 0.01 * i));
  std::vector<int> seen;
  CaptureLoop loop(std::make_shared<ScriptedSensor>(std::move(script)),
                   [&](const Frame& frame) { seen.push_back(frame.index.value); });
  wait_for(loop, SensorState::kEnded);
  loop.stop();
  ASSERT_EQ(seen.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(seen[i], i);
}

TEST(CaptureLoop, ContinuesWhenALostSensorIsBack) {
  Script script = {ScriptedSensor::frame(0, 0.0), ScriptedSensor::nothing(SensorState::kLost),
                   ScriptedSensor::nothing(SensorState::kLost),
                   ScriptedSensor::nothing(SensorState::kRunning), ScriptedSensor::frame(1, 1.0)};
  std::vector<double> times;
  CaptureLoop loop(std::make_shared<ScriptedSensor>(std::move(script)),
                   [&](const Frame& frame) { times.push_back(frame.time_s); });
  wait_for(loop, SensorState::kEnded);
  loop.stop();
  EXPECT_EQ(times, (std::vector<double>{0.0, 1.0}));
}

TEST(CaptureLoop, KeepsTheMessageOfAFailedSensor) {
  Script script = {ScriptedSensor::frame(0, 0.0), ScriptedSensor::failure("unplugged; plug it in"),
                   ScriptedSensor::frame(1, 1.0)};
  int count = 0;
  CaptureLoop loop(std::make_shared<ScriptedSensor>(std::move(script)),
                   [&](const Frame&) { ++count; });
  wait_for(loop, SensorState::kFailed);
  EXPECT_EQ(loop.status().message, "unplugged; plug it in");
  loop.stop();
  EXPECT_EQ(count, 1) << "the loop must not ask for frames after a failure";
}

TEST(CaptureLoop, StopsDuringAnEndlessStream) {
  std::promise<void> running;
  Script script(200000, ScriptedSensor::nothing(SensorState::kRunning));
  script.push_front(ScriptedSensor::frame(0, 0.0));
  CaptureLoop loop(std::make_shared<ScriptedSensor>(std::move(script)),
                   [&](const Frame&) { running.set_value(); });
  running.get_future().wait();
  loop.stop();
  EXPECT_EQ(loop.status().state, SensorState::kIdle);
  loop.stop();
}

}  // namespace
}  // namespace flytri::device
