
#include <gmock/gmock.h>
#include <linux/videodev2.h>

#include <cerrno>

#include "hw/stream/streamed_camera.h"
#include "hw/v4l2/v4l2_driver.h"
#include "tests/support/fake_video.h"
#include "tests/support/manual_clock.h"

namespace flytri::v4l2 {
namespace {

using testing::FakeBuffer;
using testing::FakeCamera;
using testing::FakeVideoSystem;
using ::testing::HasSubstr;
using testing::ManualClock;

constexpr double kPeriod_s = 0.1;

// A fake camera with 4 x 2 grey pixels at 10 Hz, and the camera that reads it.
class V4l2CameraTest : public ::testing::Test {
 protected:
  V4l2CameraTest() {
    fake_->fourcc = V4L2_PIX_FMT_GREY;
    settings_.size = {4, 2};
    settings_.rate_hz = 1.0 / kPeriod_s;
  }

  void make_camera(const device::CameraMatch& match = {}) {
    auto camera = stream::StreamedCamera::create(driver_, match, settings_, {}, clock_.clock());
    ASSERT_TRUE(camera) << camera.error().message;
    camera_ = std::move(*camera);
  }

  void start() {
    make_camera();
    const auto started = camera_->start();
    ASSERT_TRUE(started) << started.error().message;
  }

  // Delivers a frame one period after the previous one.
  FakeBuffer& deliver(std::uint32_t sequence) {
    clock_.turn(kPeriod_s);
    fake_->frames.push_back({std::vector<std::uint8_t>(8, 7), sequence, clock_.now_s() - 0.01});
    return fake_->frames.back();
  }

  device::CameraFrame take() {
    const auto next = camera_->next(0.0);
    EXPECT_TRUE(next && *next);
    return next && *next ? **next : device::CameraFrame{};
  }

  void expect_none(double timeout_s) {
    const auto next = camera_->next(timeout_s);
    ASSERT_TRUE(next);
    EXPECT_FALSE(*next);
  }

  ManualClock clock_;
  std::shared_ptr<FakeVideoSystem> system_ = std::make_shared<FakeVideoSystem>(clock_.clock());
  std::shared_ptr<FakeCamera> fake_ = system_->add();
  device::CameraSettings settings_;
  std::shared_ptr<V4l2Driver> driver_ = std::make_shared<V4l2Driver>(system_);
  std::unique_ptr<device::Camera> camera_;
};

TEST_F(V4l2CameraTest, SetsControlsAgainThatTheCameraResetsWhenItsStreamStarts) {
  fake_->controls[V4L2_CID_EXPOSURE_ABSOLUTE] = {1, 5000, 156, 156, "Exposure"};
  fake_->controls[V4L2_CID_GAMMA] = {72, 500, 220, 220, "Gamma"};
  fake_->reset_at_start = {{V4L2_CID_EXPOSURE_ABSOLUTE, 300}, {V4L2_CID_GAMMA, 220}};
  settings_.exposure_s = 0.005;
  start();
  EXPECT_EQ(fake_->controls[V4L2_CID_EXPOSURE_ABSOLUTE].value, 50);
  EXPECT_EQ(fake_->controls[V4L2_CID_GAMMA].value, 100);
  EXPECT_DOUBLE_EQ(*camera_->read_back().exposure_s, 0.005);
  EXPECT_EQ(camera_->read_back().controls.at("gamma"), 100.0);
}

// Ten bits in Y16, first in the dark.
TEST_F(V4l2CameraTest, LearnsHowManyBitsOfY16AreUsed) {
  fake_->fourcc = V4L2_PIX_FMT_Y16;
  settings_.format = device::PixelFormat::kGrey16;
  start();
  const auto pixel = [&](std::uint32_t sequence, std::uint16_t raw) {
    std::vector<std::uint8_t> bytes(16, 0);
    bytes[0] = static_cast<std::uint8_t>(raw);
    bytes[1] = static_cast<std::uint8_t>(raw >> 8);
    deliver(sequence).bytes = bytes;
    return take().image.at<std::uint16_t>(0, 0);
  };
  EXPECT_EQ(pixel(0, 20), 20 << 6);
  EXPECT_EQ(pixel(1, 1023), 1023 << 6);
  EXPECT_EQ(pixel(2, 4095), 4095 << 4) << "it has twelve";
  EXPECT_EQ(pixel(3, 1023), 1023 << 4) << "what was learned stays";
}

TEST_F(V4l2CameraTest, DeliversImagesWithTimeAndNumberOfTheDriver) {
  start();
  deliver(0).bytes = {1, 2, 3, 4, 5, 6, 7, 8};
  const device::CameraFrame frame = take();
  EXPECT_EQ(frame.image.at<std::uint8_t>(1, 3), 8);
  // The driver's times are whole microseconds.
  EXPECT_NEAR(frame.time_s, clock_.now_s() - 0.01, 1e-6);
  EXPECT_EQ(frame.stamp, device::StampMeaning::kEndOfReadout);
  EXPECT_EQ(frame.sequence, 0);
  EXPECT_FALSE(frame.damaged);
  deliver(1).flags = V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  EXPECT_EQ(take().stamp, device::StampMeaning::kStartOfExposure);
  EXPECT_EQ(camera_->status().delivered, 2);
}

TEST_F(V4l2CameraTest, CountsGapsAcrossAWrapAroundOfTheNumber) {
  start();
  deliver(0);
  take();
  deliver(4);
  EXPECT_EQ(take().sequence, 4);
  EXPECT_EQ(camera_->status().dropped, 3);
  start();
  deliver(0xffffffff);
  const std::int64_t first = take().sequence;
  deliver(1);
  EXPECT_EQ(take().sequence, first + 2);
  EXPECT_EQ(camera_->status().dropped, 1);
}

TEST_F(V4l2CameraTest, MarksAndCountsDamagedFrames) {
  start();
  deliver(0).flags = V4L2_BUF_FLAG_ERROR;
  EXPECT_TRUE(take().damaged);
  deliver(1).bytes.resize(5);
  EXPECT_TRUE(take().damaged);
  deliver(2);
  EXPECT_FALSE(take().damaged);
  EXPECT_EQ(camera_->status().flagged, 1);
  EXPECT_EQ(camera_->status().short_frames, 1);
  EXPECT_EQ(camera_->status().delivered, 3);
}

TEST_F(V4l2CameraTest, ReplacesImplausibleTimesByTheTimeOfArrival) {
  start();
  deliver(0).monotonic = false;
  EXPECT_EQ(take().time_s, clock_.now_s());
  deliver(1).time_s = clock_.now_s() + 1.0;  // in the future
  EXPECT_EQ(take().time_s, clock_.now_s());
  deliver(2).time_s = 1.0;  // backwards
  EXPECT_EQ(take().time_s, clock_.now_s());
  EXPECT_EQ(camera_->status().restamped, 3);
}

TEST_F(V4l2CameraTest, ReconnectsUnderAnotherDeviceFile) {
  start();
  deliver(0);
  const std::int64_t before = take().sequence;
  fake_->present = false;
  expect_none(0.0);
  EXPECT_EQ(camera_->status().state, device::CameraState::kLost);
  for (int i = 0; i < 5; ++i) expect_none(1.0);
  EXPECT_EQ(camera_->status().lost, 1);
  EXPECT_THAT(camera_->status().message, HasSubstr("plug it in"));
  fake_->present = true;
  fake_->node.node = "/dev/video7";
  expect_none(1.0);
  EXPECT_EQ(camera_->status().state, device::CameraState::kRunning);
  EXPECT_EQ(camera_->status().returned, 1);
  deliver(0);
  EXPECT_GE(take().sequence, before + 2);
  EXPECT_EQ(camera_->status().restarted, 0);
}

TEST_F(V4l2CameraTest, RestartsABrokenStream) {
  start();
  deliver(0).error = EIO;
  expect_none(0.0);
  EXPECT_EQ(camera_->status().state, device::CameraState::kLost);
  expect_none(0.0);
  EXPECT_EQ(camera_->status().state, device::CameraState::kRunning);
  EXPECT_EQ(camera_->status().restarted, 1);
  EXPECT_EQ(camera_->status().lost, 0);
  EXPECT_EQ(fake_->streaming, 1);
  deliver(0);
  take();
}

TEST_F(V4l2CameraTest, CountsFrozenOnceAndRestartsUntilFramesArrive) {
  start();
  deliver(0);
  take();
  expect_none(4.0 * kPeriod_s);
  EXPECT_EQ(camera_->status().state, device::CameraState::kRunning);
  expect_none(2.0 * kPeriod_s);
  EXPECT_EQ(camera_->status().state, device::CameraState::kFrozen);
  for (int i = 0; i < 60; ++i) expect_none(kPeriod_s);
  EXPECT_EQ(camera_->status().state, device::CameraState::kFrozen);
  EXPECT_EQ(camera_->status().frozen, 1);
  EXPECT_GE(camera_->status().restarted, 2);
  deliver(0);
  take();
  EXPECT_EQ(camera_->status().state, device::CameraState::kRunning);
  EXPECT_EQ(camera_->status().message, "");
}

TEST_F(V4l2CameraTest, IsFrozenAfterOneLongWaitWithoutAFrame) {
  start();
  expect_none(3.0);
  EXPECT_EQ(camera_->status().state, device::CameraState::kFrozen);
  EXPECT_EQ(camera_->status().frozen, 1);
  expect_none(0.0);
  EXPECT_EQ(camera_->status().state, device::CameraState::kFrozen);
  EXPECT_EQ(camera_->status().restarted, 1);
}

TEST_F(V4l2CameraTest, DoesNotRestartASlowCamera) {
  settings_.rate_hz = 0.4;
  start();
  for (std::uint32_t i = 0; i < 3; ++i) {
    expect_none(2.4);
    deliver(i);
    take();
  }
  EXPECT_EQ(camera_->status().frozen, 0);
  EXPECT_EQ(camera_->status().restarted, 0);
}

TEST_F(V4l2CameraTest, StopReleasesTheCamera) {
  start();
  EXPECT_EQ(fake_->streaming, 1);
  camera_->stop();
  EXPECT_EQ(fake_->streaming, 0);
  EXPECT_EQ(camera_->next(0.0).error().code, ErrorCode::kBadOption);
  ASSERT_TRUE(camera_->start());
  EXPECT_EQ(camera_->status().state, device::CameraState::kRunning);
}

TEST_F(V4l2CameraTest, ReportsAFailedStart) {
  const auto expect_failure = [&](ErrorCode code, const std::string& remedy) {
    make_camera();
    const auto started = camera_->start();
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error().code, code);
    EXPECT_THAT(started.error().message, HasSubstr(remedy));
    EXPECT_EQ(camera_->status().state, device::CameraState::kFailed);
    EXPECT_EQ(camera_->status().message, started.error().message);
  };
  fake_->open_error = EACCES;
  expect_failure(ErrorCode::kNotPermitted, "group \"video\"");
  fake_->open_error = 0;
  fake_->errors[VIDIOC_REQBUFS] = EBUSY;
  expect_failure(ErrorCode::kInconsistent, "close that program");
  fake_->errors.clear();
  fake_->errors[VIDIOC_STREAMON] = ENOSPC;
  expect_failure(ErrorCode::kBadOption, "USB bus is too slow");
  fake_->errors.clear();
  settings_.format = device::PixelFormat::kGrey12;
  expect_failure(ErrorCode::kBadOption, "choose one of GREY 4 x 2");
  fake_->present = false;
  expect_failure(ErrorCode::kNotFound, "plug it in");
}

TEST_F(V4l2CameraTest, RefusesOptionsOutOfRange) {
  settings_.rate_hz = 0.0;
  EXPECT_FALSE(stream::StreamedCamera::create(driver_, {}, settings_));
  settings_.rate_hz = 30.0;
  EXPECT_FALSE(stream::StreamedCamera::create(driver_, {}, settings_, {.buffers = 1}));
}

}  // namespace
}  // namespace flytri::v4l2
