/// @file  A rig records exactly the frames that it delivers, even if its camera is unplugged
/// meanwhile.
#include <gtest/gtest.h>

#include <vector>

#include "core/io/recordings/recording.h"
#include "hw/recording/recorder_sensor.h"
#include "tests/support/simulated_rig.h"
#include "tests/support/temporary_folder.h"

namespace flytri::rig {
namespace {

using testing::make_simulated_rig;
using testing::SimulatedRig;
using testing::SimulatedRigOptions;

void run(recording::RecorderSensor& recorder, const SimulatedRig& rig, double duration_s,
         std::vector<Frame>& frames) {
  const double end_s = rig.clock.now_s() + duration_s;
  while (rig.clock.now_s() < end_s) {
    auto frame = recorder.next(0.05);
    ASSERT_TRUE(frame) << frame.error().message;
    if (*frame) frames.push_back(**frame);
    while (recorder.work_in_background(0.0)) {
    }
  }
}

TEST(RigRecording, IsBitIdenticalToTheLiveFramesEvenAfterUnplugging) {
  SimulatedRigOptions options;
  options.measurement.noise = options.texture.noise = 0.004;
  options.texture.latency_s = 0.06;
  options.texture.settings.channels = device::Channels::kRgb;
  const SimulatedRig rig = make_simulated_rig(options);
  const TemporaryFolder folder;
  const auto recorder = recording::RecorderSensor::create(rig.sensor, folder / "scan").value();
  std::vector<Frame> live;
  ASSERT_TRUE(recorder->start());
  run(*recorder, rig, 4.0, live);
  rig.measurement->set_plugged(false);
  run(*recorder, rig, 1.0, live);
  // The list already contains the frames so far, so a crash while the device is unplugged would not
  // lose them.
  EXPECT_TRUE(io::open_recording(folder / "scan"));
  rig.measurement->set_plugged(true);
  run(*recorder, rig, 3.0, live);
  recorder->stop();
  EXPECT_EQ(recorder->recorder_status().lost, 0);
  const io::Recording recording = io::open_recording(folder / "scan").value();
  ASSERT_EQ(recording.frames.size(), live.size());
  EXPECT_GT(live.size(), 120U);
  for (std::size_t i = 0; i < live.size(); ++i) {
    const Frame replayed = io::load_frame(recording, FrameIndex(i)).value();
    EXPECT_EQ(replayed.kind, live[i].kind);
    EXPECT_EQ(replayed.time_s, live[i].time_s);
    ASSERT_EQ(replayed.image.type(), live[i].image.type());
    EXPECT_EQ(cv::norm(replayed.image, live[i].image, cv::NORM_INF), 0.0);
  }
}

}  // namespace
}  // namespace flytri::rig
