#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "hw/device/clock.h"
#include "hw/genicam/aravis.h"
#include "hw/genicam/genicam_driver.h"
#include "hw/stream/streamed_camera.h"

namespace flytri::genicam {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The camera that Aravis simulates inside the program.
const device::CameraMatch kSimulated{"Aravis Fake", "", ""};

class GenicamCamera : public ::testing::Test {
 protected:
  GenicamCamera() {
    settings_.size = {320, 200};
    settings_.rate_hz = 50.0;
  }

  std::unique_ptr<device::Camera> make(const device::CameraMatch& match = kSimulated) {
    stream::StreamedCameraOptions options;
    options.restart_after_s = 0.5;
    return stream::StreamedCamera::create(driver_, match, settings_, options).value();
  }

  std::string refusal() {
    const auto started = make()->start();
    return started ? std::string() : started.error().message;
  }

  /// The next frames, within some seconds.
  static std::vector<device::CameraFrame> read(device::Camera& camera, std::size_t count) {
    std::vector<device::CameraFrame> frames;
    const device::Clock clock = device::machine_clock();
    for (const double end_s = clock.now_s() + 20.0;
         frames.size() < count && clock.now_s() < end_s;) {
      const auto next = camera.next(0.5);
      if (!next) break;
      if (*next) frames.push_back(**next);
    }
    EXPECT_EQ(frames.size(), count) << camera.status().message;
    return frames;
  }

  std::shared_ptr<GenicamDriver> driver_ =
      std::make_shared<GenicamDriver>(GenicamDriverOptions{.has_simulated = true});
  device::CameraSettings settings_;
};

TEST_F(GenicamCamera, DeliversFramesWithTimesAndNumbersInOrder) {
  const auto camera = make();
  const auto started = camera->start();
  ASSERT_TRUE(started) << started.error().message;
  const double now_s = device::machine_clock().now_s();
  const auto frames = read(*camera, 20);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].image.size(), cv::Size(320, 200));
    EXPECT_EQ(frames[i].image.type(), CV_8UC1);
    EXPECT_FALSE(frames[i].damaged);
    EXPECT_NEAR(frames[i].time_s, now_s, 20.0);
    if (i == 0) continue;
    EXPECT_GT(frames[i].time_s, frames[i - 1].time_s);
    EXPECT_GT(frames[i].sequence, frames[i - 1].sequence);
  }
  EXPECT_EQ(camera->status().delivered, 20);
  EXPECT_EQ(camera->status().restamped, 0);
  EXPECT_THAT(camera->name(), HasSubstr("Aravis"));
}

TEST_F(GenicamCamera, KeepsTheRateAskedFor) {
  const auto camera = make();
  ASSERT_TRUE(camera->start());
  EXPECT_NEAR(camera->read_back().rate_hz, 50.0, 0.5);
  const auto frames = read(*camera, 40);
  ASSERT_EQ(frames.size(), 40U);
  EXPECT_NEAR((frames.back().time_s - frames.front().time_s) / 39.0, 0.02, 0.002);
}

TEST_F(GenicamCamera, ReadsBackExposureGainAndControls) {
  settings_.exposure_s = 0.004;
  settings_.gain = 3.0;
  const auto camera = make();
  const auto started = camera->start();
  ASSERT_TRUE(started) << started.error().message;
  EXPECT_NEAR(camera->read_back().exposure_s.value(), 0.004, 1e-5);
  EXPECT_NEAR(camera->read_back().gain.value(), 3.0, 0.01);
}

TEST_F(GenicamCamera, GivesColorAsRedGreenBlue) {
  settings_.format = device::PixelFormat::kRgb8;
  settings_.channels = device::Channels::kRgb;
  const auto camera = make();
  const auto started = camera->start();
  ASSERT_TRUE(started) << started.error().message;
  for (const device::CameraFrame& frame : read(*camera, 2)) EXPECT_EQ(frame.image.type(), CV_8UC3);
}

TEST_F(GenicamCamera, NamesWhatItDoesNotOffer) {
  settings_.trigger = "Line77";
  EXPECT_THAT(refusal(), AllOf(HasSubstr("Line77"), HasSubstr("Software")));
  settings_.trigger.clear();
  settings_.size = {5000, 200};
  EXPECT_THAT(refusal(), AllOf(HasSubstr("5000 x 200"), HasSubstr("2048 x 2048")));
  settings_.size = {320, 200};
  settings_.format = device::PixelFormat::kMjpeg;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("MJPG"), HasSubstr("GREY")));
  settings_.format = device::PixelFormat::kGrey8;
  settings_.controls["shine"] = 1.0;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("\"shine\""), HasSubstr("rig.json")));
  settings_.controls.clear();
  settings_.exposure_s = 1000.0;
  EXPECT_THAT(refusal(), HasSubstr("exposure_s is 1000"));
  settings_.exposure_s.reset();
  settings_.focus = 3.0;
  EXPECT_THAT(refusal(), HasSubstr("focus"));
}

TEST_F(GenicamCamera, NamesTheCamerasThatAreThere) {
  const auto missing = driver_->find({"Nonesuch", "", ""});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(missing.error().message, AllOf(HasSubstr("\"Nonesuch\""), HasSubstr("Fake")));
}

TEST_F(GenicamCamera, ListsFormatsByTheNamesOfRigJson) {
  const auto cameras = driver_->list();
  ASSERT_FALSE(cameras.empty());
  std::vector<std::string> formats;
  for (const device::CameraMode& mode : cameras.front().modes) formats.push_back(mode.format);
  EXPECT_THAT(formats, ::testing::IsSupersetOf({"GREY", "Y16", "RGB3"}));
}

TEST_F(GenicamCamera, ListsItsTriggerInputsWithoutSoftware) {
  const auto cameras = driver_->list();
  ASSERT_FALSE(cameras.empty());
  const std::vector<std::string>& inputs = cameras.front().trigger_inputs;
  ASSERT_FALSE(inputs.empty());
  EXPECT_EQ(std::count(inputs.begin(), inputs.end(), "Software"), 0);
  settings_.trigger = inputs.front();
  EXPECT_THAT(driver_->check({cameras.front().name, "", ""}, settings_), ::testing::IsEmpty());
}

/// A camera that speaks GigE Vision, over the loopback network. It can be unplugged.
class GigeCamera : public GenicamCamera {
 protected:
  void plug_in() { simulated_.reset(arv_gv_fake_camera_new("127.0.0.1", "FLYTRI")); }
  void unplug() { simulated_.reset(); }

  bool read_until(device::Camera& camera,
                  const std::function<bool(const device::CameraStatus&)>& wanted) {
    const device::Clock clock = device::machine_clock();
    const double end_s = clock.now_s() + 30.0;
    while (clock.now_s() < end_s) {
      const auto next = camera.next(0.2);
      if (!next) return false;
      if (wanted(camera.status())) return true;
    }
    return false;
  }

  const device::CameraMatch match_{"", "FLYTRI", ""};
  Owned<ArvGvFakeCamera> simulated_;
};

TEST_F(GigeCamera, StreamsOverTheNetwork) {
  plug_in();
  const auto camera = make(match_);
  const auto started = camera->start();
  ASSERT_TRUE(started) << started.error().message;
  const auto frames = read(*camera, 10);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_GT(frames[i].time_s, frames[i - 1].time_s);
}

/// Without triggers it is silent, and that is no fault.
TEST_F(GigeCamera, WaitsForItsTrigger) {
  plug_in();
  settings_.trigger = "Software";
  const auto camera = make(match_);
  const auto started = camera->start();
  ASSERT_TRUE(started) << started.error().message;
  for (int i = 0; i < 8; ++i) {
    const auto next = camera->next(0.1);
    ASSERT_TRUE(next);
    EXPECT_FALSE(*next);
  }
  EXPECT_EQ(camera->status().state, device::CameraState::kRunning);
  EXPECT_EQ(camera->status().restarted, 0);
  camera->stop();
  settings_.trigger.clear();
  const auto free_running = make(match_);
  ASSERT_TRUE(free_running->start());
  (void)read(*free_running, 3);
}

TEST_F(GigeCamera, GoesOnAfterItWasUnplugged) {
  plug_in();
  const auto camera = make(match_);
  ASSERT_TRUE(camera->start());
  (void)read(*camera, 3);
  unplug();
  ASSERT_TRUE(read_until(*camera, [](const device::CameraStatus& status) {
    return status.state == device::CameraState::kLost;
  })) << to_string(camera->status().state);
  EXPECT_EQ(camera->status().lost, 1);
  plug_in();
  ASSERT_TRUE(read_until(*camera, [](const device::CameraStatus& status) {
    return status.state == device::CameraState::kRunning;
  })) << camera->status().message;
  EXPECT_EQ(camera->status().returned, 1);
  (void)read(*camera, 3);
}

}  // namespace
}  // namespace flytri::genicam
