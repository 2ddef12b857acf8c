#include "hw/rig/rig_sensor.h"

#include <gtest/gtest.h>

#include <vector>

#include "hw/sync/image_light.h"
#include "tests/support/simulated_rig.h"

namespace flytri::rig {
namespace {

using testing::make_simulated_rig;
using testing::SimulatedRig;
using testing::SimulatedRigOptions;

SimulatedRigOptions usual() {
  SimulatedRigOptions options;
  options.measurement.noise = options.texture.noise = 0.004;
  options.measurement.latency_s = 0.045;
  options.texture.latency_s = 0.07;
  options.texture.phase_s = 0.011;
  options.texture.settings.channels = device::Channels::kRgb;
  return options;
}

std::vector<Frame> run(const SimulatedRig& rig, double duration_s) {
  std::vector<Frame> frames;
  const double end_s = rig.clock.now_s() + duration_s;
  while (rig.clock.now_s() < end_s) {
    auto frame = rig.sensor->next(0.05);
    EXPECT_TRUE(frame) << frame.error().message;
    if (!frame) break;
    if (*frame) frames.push_back(**frame);
  }
  return frames;
}

int count(const std::vector<Frame>& frames, FrameKind kind) {
  return static_cast<int>(std::count_if(frames.begin(), frames.end(),
                                        [&](const Frame& frame) { return frame.kind == kind; }));
}

/// Checks that every frame shows the light of its label and that times increase.
void expect_true(const std::vector<Frame>& frames) {
  double before_s = 0.0;
  std::size_t index = 0;
  for (const Frame& frame : frames) {
    EXPECT_GT(frame.time_s, before_s);
    before_s = frame.time_s;
    EXPECT_EQ(frame.index.at(), index++);
    const sync::ImageLight light = sync::measure_image_light(frame.image);
    if (frame.kind == FrameKind::kTexture) {
      EXPECT_EQ(frame.image.type(), CV_8UC3);
      EXPECT_GT(light.area, 0.1);
    } else {
      EXPECT_EQ(frame.image.type(), CV_8UC1);
      // When the switch is unplugged, lights turn dark by themselves: a frame without light is not
      // a wrong label.
      if (light.line_places == 0) continue;
      EXPECT_GT(
          frame.kind == FrameKind::kVertical ? light.column_share() : 1.0 - light.column_share(),
          0.9);
    }
  }
}

TEST(RigSensor, RunsTheLightSequenceOfThePaper) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  const auto frames = run(rig, 10.0);
  expect_true(frames);
  // About 27 patterns and one flash per second, once the latency is known.
  EXPECT_GT(count(frames, FrameKind::kVertical), 110);
  EXPECT_GT(count(frames, FrameKind::kHorizontal), 110);
  EXPECT_GE(count(frames, FrameKind::kTexture), 6);
  EXPECT_LE(count(frames, FrameKind::kTexture), 11);
  const RigStatus status = rig.sensor->rig_status();
  EXPECT_TRUE(status.keeps_step);
  EXPECT_NEAR(status.measurement.latency.latency_s, 0.045, 0.004);
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kRunning);
  EXPECT_EQ(rig.sensor->status().message, "");
  EXPECT_EQ(rig.sensor->status().delivered, static_cast<std::int64_t>(frames.size()));
}

TEST(RigSensor, PatternsContinueToAlternateAfterAFlash) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  run(rig, 3.0);
  const auto frames = run(rig, 5.0);
  FrameKind before = FrameKind::kUnknown;
  int repeated = 0;
  for (const Frame& frame : frames) {
    if (frame.kind == FrameKind::kTexture) continue;
    repeated += frame.kind == before ? 1 : 0;
    before = frame.kind;
  }
  EXPECT_LE(repeated, 1);
}

TEST(RigSensor, IsDarkAfterStopAndCanBeRestarted) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  run(rig, 2.0);
  rig.sensor->stop();
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kIdle);
  rig.clock.turn(1.0);
  const double now_s = rig.clock.now_s();
  EXPECT_NEAR(rig.lights->truth(now_s - 0.5, now_s).lit(device::Light::kDark), 0.5, 1e-9);
  EXPECT_FALSE(rig.sensor->next(0.01));
  ASSERT_TRUE(rig.sensor->start());
  const auto frames = run(rig, 4.0);
  expect_true(frames);
  EXPECT_GT(frames.size(), 60U);
}

TEST(RigSensor, RestsDarkAndGoesOnAtOnceWithTheLatencyItKnows) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  auto frames = run(rig, 4.0);
  rig.sensor->rest(true);
  run(rig, 0.3);
  EXPECT_TRUE(run(rig, 60.0).empty());
  const double now_s = rig.clock.now_s();
  EXPECT_NEAR(rig.lights->truth(now_s - 60.0, now_s).lit(device::Light::kDark), 60.0, 1e-9);
  EXPECT_EQ(rig.sensor->status().message, "");
  rig.sensor->rest(false);
  const auto after = run(rig, 2.0);
  EXPECT_GT(after.size(), 40U);
  frames.insert(frames.end(), after.begin(), after.end());
  expect_true(frames);
}

// Nobody calls next(): what was requested last would stay on.
TEST(RigSensor, AHungReaderLeavesNoLightOnForLongerThanItsLimit) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  run(rig, 4.0);
  rig.clock.turn(60.0);
  const double now_s = rig.clock.now_s();
  EXPECT_GT(rig.lights->truth(now_s - 60.0, now_s).lit(device::Light::kDark), 57.5);
  EXPECT_EQ(rig.lights->status().limited, 1);
}

TEST(RigSensor, RefusesAFlashPeriodThatKeepsTheFlashOn) {
  SimulatedRigOptions options = usual();
  options.sensor.flash_period_s = 0.1;
  const SimulatedRig rig = make_simulated_rig(options);
  const auto started = rig.sensor->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kBadOption);
  EXPECT_NE(started.error().message.find("set flash_period_s to"), std::string::npos);
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kFailed);
}

TEST(RigSensor, KeepsTheLimitsWhileItLearnsAndMeasures) {
  SimulatedRigOptions options = usual();
  options.sensor.limits.flash = options.lights.limits.flash = {0.5, 0.12};
  const SimulatedRig rig = make_simulated_rig(options);
  ASSERT_TRUE(rig.sensor->start());
  expect_true(run(rig, 20.0));
  EXPECT_EQ(rig.sensor->rig_status().lights.limited, 0);
}

TEST(RigSensor, ReconnectsAnUnpluggedCamera) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  run(rig, 3.0);
  rig.measurement->set_plugged(false);
  run(rig, 1.0);
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kLost);
  EXPECT_NE(rig.sensor->status().message, "");
  rig.measurement->set_plugged(true);
  const auto frames = run(rig, 4.0);
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kRunning);
  EXPECT_EQ(rig.sensor->status().message, "");
  EXPECT_GT(frames.size(), 90U);
}

TEST(RigSensor, UnpluggedLightsMakeTheSensorLostWithoutWrongLabels) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  auto frames = run(rig, 3.0);
  rig.lights->set_plugged(false);
  const auto without = run(rig, 2.0);
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kLost);
  EXPECT_LT(without.size(), 10U);
  rig.lights->set_plugged(true);
  const auto after = run(rig, 4.0);
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kRunning);
  EXPECT_GT(after.size(), 80U);
  for (const auto* part : {&without, &after})
    frames.insert(frames.end(), part->begin(), part->end());
  expect_true(frames);
}

TEST(RigSensor, ContinuesWithoutTextureCameraAndReportsIt) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  run(rig, 3.0);
  rig.texture->set_plugged(false);
  const auto frames = run(rig, 3.0);
  EXPECT_GT(frames.size(), 70U);
  EXPECT_EQ(rig.sensor->status().state, device::SensorState::kRunning);
  EXPECT_NE(rig.sensor->status().message, "");
}

TEST(RigSensor, ReportsSwappedProjectorsAndLabelsFramesByWhatTheyShow) {
  SimulatedRigOptions options = usual();
  options.lights.faults.is_swapped = true;
  const SimulatedRig rig = make_simulated_rig(options);
  ASSERT_TRUE(rig.sensor->start());
  const auto frames = run(rig, 6.0);
  expect_true(frames);
  EXPECT_GT(frames.size(), 100U);
  EXPECT_NE(rig.sensor->status().message.find("swapped"), std::string::npos);
}

TEST(RigSensor, DropsFramesWhoseImageContradictsThePrediction) {
  const SimulatedRig rig = make_simulated_rig(usual());
  ASSERT_TRUE(rig.sensor->start());
  auto frames = run(rig, 3.0);
  // Swapped cables during the scan: the prediction stays certain.
  rig.lights->set_faults({.is_swapped = true});
  const auto after = run(rig, 4.0);
  frames.insert(frames.end(), after.begin(), after.end());
  expect_true(frames);
  EXPECT_GT(rig.sensor->rig_status().measurement.labels.unknown +
                rig.sensor->rig_status().measurement.labels.straddled,
            20);
}

TEST(RigSensor, AnUnresponsiveSwitchDoesNotBlockTheCapture) {
  SimulatedRigOptions options = usual();
  options.lights.call_s = 4.0;
  options.lights.faults.is_mute = true;
  const SimulatedRig rig = make_simulated_rig(options);
  ASSERT_TRUE(rig.sensor->start());
  const auto frames = run(rig, 8.0);
  EXPECT_TRUE(frames.empty());
  const RigStatus status = rig.sensor->rig_status();
  EXPECT_GT(status.measurement.camera.delivered, 200);
  EXPECT_NE(rig.sensor->status().message, "");
}

TEST(RigSensor, RunsWithoutTextureCamera) {
  SimulatedRigOptions options = usual();
  options.has_texture = false;
  const SimulatedRig rig = make_simulated_rig(options);
  ASSERT_TRUE(rig.sensor->start());
  const auto frames = run(rig, 6.0);
  expect_true(frames);
  EXPECT_GT(frames.size(), 120U);
}

TEST(RigSensor, NeedsACameraAndLights) { EXPECT_FALSE(RigSensor::create({}, {}, nullptr)); }

}  // namespace
}  // namespace flytri::rig
