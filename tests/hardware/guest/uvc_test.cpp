// Tests USB cameras with the kernel driver uvcvideo, on devices emulated by flytri_usb_devices.

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "hw/v4l2/find_camera.h"
#include "tests/hardware/guest/camera_reader.h"
#include "tests/hardware/guest/usb_bench.h"

namespace flytri {
namespace {

using testing::CameraReader;
using testing::send_command;

const device::CameraMatch kMono{"", "M0001", ""};   // bulk transfers
const device::CameraMatch kColor{"", "C0002", ""};  // isochronous transfers
constexpr double kRate_hz = 25.0;

device::CameraSettings settings(device::PixelFormat format = device::PixelFormat::kGrey8) {
  device::CameraSettings settings;
  settings.format = format;
  settings.size = {320, 240};
  settings.rate_hz = kRate_hz;
  return settings;
}

class UvcTest : public ::testing::Test {
 protected:
  UvcTest() { testing::restore_all(); }

  // Sets whether the driver passes on damaged images or drops them; applies when a camera is
  // plugged in.
  static void hand_on_damaged(bool wanted) {
    std::ofstream("/sys/module/uvcvideo/parameters/nodrop") << (wanted ? 1 : 0);
    send_command("unplug camera");
    testing::wait_until([] { return !v4l2::find_camera(*v4l2::kernel_video_system(), kMono); });
    testing::restore_all();
  }
};

TEST_F(UvcTest, StreamsAtTheSetRateWithoutLoss) {
  for (const device::CameraMatch& match : {kMono, kColor}) {
    SCOPED_TRACE(match.serial);
    CameraReader reader(match, settings());
    ASSERT_NO_FATAL_FAILURE(reader.start());
    ASSERT_NO_FATAL_FAILURE(reader.read(30));
    reader.expect_order();
    const auto& frames = reader.frames();
    EXPECT_NEAR(29.0 / (frames.back().time_s - frames.front().time_s), kRate_hz, 1.0);
    const device::CameraStatus status = reader.camera().status();
    EXPECT_EQ(status.dropped, 0);
    EXPECT_EQ(status.restamped, 0);
    EXPECT_EQ(status.flagged + status.short_frames + status.undecodable, 0);
  }
}

// The dark background of the image is uniform: 16 to 47 in each format.
TEST_F(UvcTest, ShowsTheImageInEveryFormat) {
  for (const device::PixelFormat format :
       {device::PixelFormat::kGrey8, device::PixelFormat::kYuyv, device::PixelFormat::kMjpeg}) {
    for (const device::Channels channels : {device::Channels::kGrey, device::Channels::kRgb}) {
      SCOPED_TRACE(to_string(format));
      device::CameraSettings wanted = settings(format);
      wanted.channels = channels;
      CameraReader reader(kMono, wanted);
      ASSERT_NO_FATAL_FAILURE(reader.start());
      ASSERT_NO_FATAL_FAILURE(reader.read(2));
      const bool color =
          format != device::PixelFormat::kGrey8 && channels == device::Channels::kRgb;
      ASSERT_EQ(reader.last_image().type(), color ? CV_8UC3 : CV_8UC1);
      double darkest = 0.0;
      double brightest = 0.0;
      cv::minMaxLoc(reader.last_image().reshape(1), &darkest, &brightest);
      EXPECT_LE(brightest - darkest, 2.0);  // rounding of JPEG
      EXPECT_LE(brightest, 48.0);
      EXPECT_GT(brightest, 0.0);
      EXPECT_EQ(reader.camera().status().undecodable, 0);
    }
  }
}

TEST_F(UvcTest, SetsControlsAndReadsThemBack) {
  device::CameraSettings wanted = settings();
  wanted.exposure_s = 0.005;
  wanted.gain = 20.0;
  wanted.white_balance_k = 5000.0;
  wanted.focus = 100.0;
  CameraReader reader(kMono, wanted);
  ASSERT_NO_FATAL_FAILURE(reader.start());
  const device::CameraSettings read_back = reader.camera().read_back();
  EXPECT_DOUBLE_EQ(*read_back.exposure_s, 0.005);
  EXPECT_EQ(read_back.gain, 20.0);
  EXPECT_EQ(read_back.white_balance_k, 5000.0);
  EXPECT_EQ(read_back.focus, 100.0);
  int automatics = 0;
  for (const device::CameraDescription& camera : v4l2::list_cameras(*v4l2::kernel_video_system())) {
    if (camera.serial != kMono.serial) continue;
    for (const device::CameraControl& control : camera.controls) {
      if (control.name.find("Auto") == std::string::npos) continue;
      ++automatics;
      EXPECT_EQ(control.value, control.name == "Auto Exposure" ? 1.0 : 0.0) << control.name;
    }
  }
  EXPECT_GE(automatics, 3);
}

TEST_F(UvcTest, CountsImagesDroppedByTheDriver) {
  CameraReader reader(kMono, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  for (const char* fault : {"short camera", "error camera"}) {
    ASSERT_NO_FATAL_FAILURE(reader.read(5));
    send_command(fault);
  }
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  reader.expect_order();
  EXPECT_EQ(reader.camera().status().dropped, 2);
  EXPECT_EQ(reader.camera().status().flagged, 0);
}

TEST_F(UvcTest, MarksAndCountsDamagedImages) {
  hand_on_damaged(true);
  CameraReader reader(kMono, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  send_command("short camera");
  reader.read_until([](const device::CameraStatus& status) { return status.short_frames == 1; });
  EXPECT_TRUE(reader.frames().back().damaged);
  // The lower half is missing.
  EXPECT_EQ(reader.last_image().at<std::uint8_t>(239, 0), 0);
  EXPECT_GT(reader.last_image().at<std::uint8_t>(0, 0), 0);
  send_command("error camera");
  reader.read_until([](const device::CameraStatus& status) { return status.flagged == 2; });
  EXPECT_TRUE(reader.frames().back().damaged);
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  EXPECT_FALSE(reader.frames().back().damaged);
  EXPECT_EQ(reader.camera().status().dropped, 0);
  reader.camera().stop();
  hand_on_damaged(false);
}

TEST_F(UvcTest, DetectsAFrozenCameraAndContinues) {
  CameraReader reader(kMono, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  send_command("freeze camera");
  reader.read_until(
      [](const device::CameraStatus& s) { return s.state == device::CameraState::kFrozen; });
  send_command("thaw camera");
  reader.read_until(
      [](const device::CameraStatus& s) { return s.state == device::CameraState::kRunning; });
  EXPECT_EQ(reader.camera().status().restarted, 0);
  // Long enough for a restart.
  send_command("freeze camera");
  reader.read_until([](const device::CameraStatus& status) { return status.restarted == 1; });
  send_command("thaw camera");
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  reader.expect_order();
  EXPECT_EQ(reader.camera().status().frozen, 2);
  EXPECT_EQ(reader.camera().status().lost, 0);
}

TEST_F(UvcTest, ReconnectsWithTheSameSettingsAfterUnplugging) {
  for (const auto& [name, match] : {std::pair{"camera", kMono}, std::pair{"camera2", kColor}}) {
    SCOPED_TRACE(name);
    device::CameraSettings wanted = settings();
    wanted.exposure_s = 0.007;
    CameraReader reader(match, wanted);
    ASSERT_NO_FATAL_FAILURE(reader.start());
    ASSERT_NO_FATAL_FAILURE(reader.read(10));
    send_command(std::string("unplug ") + name);
    reader.read_until([](const device::CameraStatus& s) { return s.lost == 1; });
    EXPECT_EQ(reader.camera().status().state, device::CameraState::kLost);
    send_command(std::string("plug ") + name);
    reader.read_until([](const device::CameraStatus& s) { return s.returned == 1; });
    ASSERT_NO_FATAL_FAILURE(reader.read(10));
    reader.expect_order();
    EXPECT_EQ(reader.frames().size(), 20U);
    EXPECT_EQ(reader.camera().status().restarted, 0);
    // The settings that the camera lost were set again.
    EXPECT_DOUBLE_EQ(*reader.camera().read_back().exposure_s, 0.007);
  }
}

TEST_F(UvcTest, UnpluggingOneCameraCostsNoFramesOfTheOther) {
  device::CameraSettings wanted = settings(device::PixelFormat::kMjpeg);
  wanted.channels = device::Channels::kRgb;
  CameraReader mono(kMono, settings());
  CameraReader color(kColor, wanted);
  ASSERT_NO_FATAL_FAILURE(mono.start());
  ASSERT_NO_FATAL_FAILURE(color.start());
  std::thread other([&] {
    color.read(5);
    send_command("unplug camera2");
    color.read_until([](const device::CameraStatus& status) { return status.lost == 1; });
    send_command("plug camera2");
    color.read(10);
  });
  mono.read(60);
  other.join();
  mono.expect_order();
  color.expect_order();
  EXPECT_EQ(mono.camera().status().dropped, 0);
  EXPECT_EQ(mono.frames().back().sequence, 59);
  EXPECT_EQ(color.camera().status().returned, 1);
}

}  // namespace
}  // namespace flytri
