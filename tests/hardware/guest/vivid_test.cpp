// Tests the camera emulated by the kernel's vivid driver, and the faults that the driver can
// simulate.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <thread>

#include "hw/v4l2/find_camera.h"
#include "tests/hardware/guest/camera_reader.h"

namespace flytri {
namespace {

using testing::CameraReader;
using ::testing::HasSubstr;

const device::CameraMatch kFirst{"vivid-000-vid-cap", "", ""};
const device::CameraMatch kSecond{"vivid-001-vid-cap", "", ""};

// Controls of the driver that cause faults.
enum class Fault : std::uint32_t {
  kDropBuffers = 0x00f0f040,  // percent
  kDisconnect,
  kFlagBuffer,
  kRefuseBuffers,
  kRefuseQueuing,
  kRefuseStream,
  kBreakStream,
};

void inject(Fault fault, int value = 1) {
  const int device = open("/dev/video10", O_RDWR);
  ASSERT_GE(device, 0);
  v4l2_control control{static_cast<std::uint32_t>(fault), value};
  const int failed = ioctl(device, VIDIOC_S_CTRL, &control);
  close(device);
  ASSERT_EQ(failed, 0);
}

device::CameraSettings settings(device::PixelFormat format = device::PixelFormat::kGrey8) {
  device::CameraSettings settings;
  settings.format = format;
  settings.size = {320, 180};
  settings.rate_hz = 50.0;
  return settings;
}

device::CameraDescription listed(const std::string& name) {
  for (device::CameraDescription& camera : v4l2::list_cameras(*v4l2::kernel_video_system()))
    if (camera.name == name) return std::move(camera);
  return {};
}

double mean_rate_hz(const std::vector<testing::ReadFrame>& frames) {
  return static_cast<double>(frames.size() - 1) / (frames.back().time_s - frames.front().time_s);
}

TEST(Vivid, StreamsAtTheSetRateWithoutLoss) {
  CameraReader reader(kFirst, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  ASSERT_NO_FATAL_FAILURE(reader.read(50));
  reader.expect_order();
  EXPECT_NEAR(mean_rate_hz(reader.frames()), 50.0, 1.0);
  const device::CameraStatus status = reader.camera().status();
  EXPECT_EQ(status.delivered, 50);
  EXPECT_EQ(status.dropped, 0);
  EXPECT_EQ(status.restamped, 0);
  EXPECT_EQ(reader.camera().read_back().rate_hz, 50.0);
}

// The driver's color bars have 75 % of full scale, or black. In YUYV the luminance is within 16 to
// 235.
TEST(Vivid, GivesTheSameImageInEveryFormat) {
  const struct {
    device::PixelFormat format;
    device::Channels channels;
    int type;
    double full_scale;
  } cases[] = {{device::PixelFormat::kGrey8, device::Channels::kGrey, CV_8UC1, 255.0},
               {device::PixelFormat::kGrey10, device::Channels::kGrey, CV_16UC1, 65535.0},
               {device::PixelFormat::kGrey12, device::Channels::kGrey, CV_16UC1, 65535.0},
               {device::PixelFormat::kGrey16, device::Channels::kGrey, CV_16UC1, 65535.0},
               {device::PixelFormat::kYuyv, device::Channels::kGrey, CV_8UC1, 255.0},
               {device::PixelFormat::kYuyv, device::Channels::kRgb, CV_8UC3, 255.0}};
  for (const auto& [format, channels, type, full_scale] : cases) {
    SCOPED_TRACE(to_string(format));
    device::CameraSettings wanted = settings(format);
    wanted.channels = channels;
    CameraReader reader(kFirst, wanted);
    ASSERT_NO_FATAL_FAILURE(reader.start());
    ASSERT_NO_FATAL_FAILURE(reader.read(2));
    ASSERT_EQ(reader.last_image().type(), type);
    ASSERT_EQ(reader.last_image().size(), cv::Size(320, 180));
    double darkest = 0.0;
    double brightest = 0.0;
    cv::minMaxLoc(reader.last_image().reshape(1), &darkest, &brightest);
    EXPECT_NEAR(brightest, 0.75 * full_scale, 0.06 * full_scale);
    EXPECT_LT(darkest, 0.07 * full_scale);
  }
}

TEST(Vivid, SetsGainAndTurnsAutomaticGainOff) {
  device::CameraSettings wanted = settings();
  wanted.gain = 77.0;
  CameraReader reader(kFirst, wanted);
  ASSERT_NO_FATAL_FAILURE(reader.start());
  EXPECT_EQ(reader.camera().read_back().gain, 77.0);
  for (const device::CameraControl& control : listed(kFirst.name).controls)
    if (control.name == "Gain, Automatic") {
      EXPECT_EQ(control.value, 0.0);
    }
}

TEST(Vivid, RefusesUnsupportedSizesAndControls) {
  device::CameraSettings wanted = settings();
  wanted.size = {333, 111};
  CameraReader size(kFirst, wanted);
  EXPECT_THAT(size.camera().start().error().message, HasSubstr("choose one of"));
  wanted = settings(device::PixelFormat::kMjpeg);
  CameraReader format(kFirst, wanted);
  EXPECT_EQ(format.camera().start().error().code, ErrorCode::kBadOption);
  wanted = settings();
  wanted.focus = 3.0;
  CameraReader focus(kFirst, wanted);
  EXPECT_THAT(focus.camera().start().error().message, HasSubstr("has no control focus"));
}

TEST(Vivid, IsListedAsBusyWhileInUse) {
  const device::CameraDescription idle = listed(kFirst.name);
  EXPECT_EQ(idle.node, "/dev/video10");
  EXPECT_TRUE(idle.problems.empty());
  EXPECT_FALSE(idle.modes.empty());
  CameraReader reader(kFirst, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  const device::CameraDescription busy = listed(kFirst.name);
  ASSERT_EQ(busy.problems.size(), 1U);
  EXPECT_THAT(busy.problems[0].message, HasSubstr("another program uses it"));
  CameraReader second(kFirst, settings());
  EXPECT_EQ(second.camera().start().error().code, ErrorCode::kInconsistent);
  ASSERT_NO_FATAL_FAILURE(reader.read(3));
}

TEST(Vivid, RunsTwoCamerasAtOnce) {
  CameraReader first(kFirst, settings());
  CameraReader second(kSecond, settings(device::PixelFormat::kYuyv));
  ASSERT_NO_FATAL_FAILURE(first.start());
  ASSERT_NO_FATAL_FAILURE(second.start());
  std::thread other([&] { second.read(40); });
  first.read(40);
  other.join();
  for (const CameraReader* reader : {&first, &second}) {
    EXPECT_EQ(reader->frames().size(), 40U);
    reader->expect_order();
  }
  EXPECT_EQ(first.camera().status().dropped, 0);
  EXPECT_EQ(second.camera().status().dropped, 0);
}

TEST(VividFault, CountsDroppedBuffers) {
  CameraReader reader(kFirst, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  inject(Fault::kDropBuffers, 30);
  reader.read(60);
  inject(Fault::kDropBuffers, 0);
  const std::int64_t missing = reader.frames().back().sequence + 1 - std::ssize(reader.frames());
  EXPECT_GT(missing, 0);
  EXPECT_EQ(reader.camera().status().dropped, missing);
}

TEST(VividFault, MarksAndCountsDamagedBuffers) {
  CameraReader reader(kFirst, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  inject(Fault::kFlagBuffer);
  ASSERT_NO_FATAL_FAILURE(reader.read(20));
  EXPECT_EQ(reader.camera().status().flagged, 1);
  EXPECT_EQ(std::count_if(reader.frames().begin(), reader.frames().end(),
                          [](const testing::ReadFrame& frame) { return frame.damaged; }),
            1);
}

TEST(VividFault, ReportsAFailedStartAndCanStartAgain) {
  for (const Fault fault : {Fault::kRefuseBuffers, Fault::kRefuseStream}) {
    CameraReader reader(kFirst, settings());
    inject(fault);
    const auto refused = reader.camera().start();
    ASSERT_FALSE(refused);
    EXPECT_EQ(reader.camera().status().state, device::CameraState::kFailed);
    EXPECT_THAT(refused.error().message, HasSubstr("vivid-000"));
    ASSERT_NO_FATAL_FAILURE(reader.start());
    ASSERT_NO_FATAL_FAILURE(reader.read(3));
  }
}

TEST(VividFault, RestartsABrokenStream) {
  for (const Fault fault : {Fault::kRefuseQueuing, Fault::kBreakStream}) {
    CameraReader reader(kFirst, settings());
    ASSERT_NO_FATAL_FAILURE(reader.start());
    ASSERT_NO_FATAL_FAILURE(reader.read(5));
    inject(fault);
    reader.read_until([](const device::CameraStatus& status) { return status.restarted == 1; });
    ASSERT_NO_FATAL_FAILURE(reader.read(5));
    reader.expect_order();
    EXPECT_EQ(reader.camera().status().lost, 0);
  }
}

TEST(VividFault, ReportsMissingPermissions) {
  const auto check = [] {
    if (setuid(65534) != 0) std::_Exit(2);
    const device::CameraDescription denied = listed(kFirst.name);
    CameraReader reader(kFirst, settings());
    const auto refused = reader.camera().start();
    const bool named = denied.problems.size() == 1 &&
                       denied.problems[0].code == ErrorCode::kNotPermitted && !refused &&
                       refused.error().code == ErrorCode::kNotPermitted &&
                       refused.error().message.find("group") != std::string::npos;
    std::_Exit(named ? 0 : 1);
  };
  EXPECT_EXIT(check(), ::testing::ExitedWithCode(0), "");
}

// Like pulling the cable: the driver removes the camera and must be loaded again.
TEST(VividFault, ReconnectsADisconnectedCamera) {
  CameraReader reader(kFirst, settings());
  ASSERT_NO_FATAL_FAILURE(reader.start());
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  inject(Fault::kDisconnect);
  reader.read_until([](const device::CameraStatus& status) { return status.lost == 1; });
  EXPECT_EQ(reader.camera().status().state, device::CameraState::kLost);
  ASSERT_EQ(std::system("rmmod vivid"), 0);
  // With other device numbers.
  ASSERT_EQ(std::system("insmod /modules/vivid.ko n_devs=2 node_types=0x1,0x1 num_inputs=1,1 "
                        "input_types=0,0 vid_cap_nr=20,21"),
            0);
  reader.read_until([](const device::CameraStatus& status) { return status.returned == 1; });
  ASSERT_NO_FATAL_FAILURE(reader.read(5));
  reader.expect_order();
  EXPECT_EQ(reader.camera().status().state, device::CameraState::kRunning);
  EXPECT_EQ(reader.camera().status().restarted, 0);
}

}  // namespace
}  // namespace flytri
