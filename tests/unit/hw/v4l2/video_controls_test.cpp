#include "hw/v4l2/video_controls.h"

#include <gmock/gmock.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <limits>

#include "hw/device/clock.h"
#include "tests/support/fake_video.h"

namespace flytri::v4l2 {
namespace {

using testing::FakeVideoSystem;
using ::testing::HasSubstr;

class VideoControlsTest : public ::testing::Test {
 protected:
  VideoControlsTest() {
    fake_->controls[V4L2_CID_EXPOSURE_AUTO] = {0, 3, V4L2_EXPOSURE_APERTURE_PRIORITY};
    fake_->controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY] = {0, 1, 1};
    fake_->controls[V4L2_CID_EXPOSURE_ABSOLUTE] = {1, 5000, 156};
    fake_->controls[V4L2_CID_AUTOGAIN] = {0, 1, 1};
    fake_->controls[V4L2_CID_GAIN] = {0, 63, 10};
    device_ = std::move(*system_.open(fake_->node.node));
  }

  Result<device::CameraSettings> set(const device::CameraSettings& settings) {
    return set_controls({*device_, fake_->node}, settings);
  }

  std::int32_t value(std::uint32_t id) { return fake_->controls.at(id).value; }

  FakeVideoSystem system_{device::machine_clock()};
  std::shared_ptr<testing::FakeCamera> fake_ = system_.add();
  std::unique_ptr<VideoDevice> device_;
};

TEST_F(VideoControlsTest, TurnsAutomaticModesOffEvenWithoutRequestedValues) {
  const auto read_back = set({});
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO_PRIORITY), 0);
  EXPECT_EQ(value(V4L2_CID_AUTOGAIN), 0);
  EXPECT_DOUBLE_EQ(*read_back->exposure_s, 0.0156);
  EXPECT_EQ(read_back->gain, 10.0);
  EXPECT_EQ(read_back->focus, std::nullopt);
}

TEST_F(VideoControlsTest, SetsValuesInStepsOfTheCameraAndReadsThemBack) {
  device::CameraSettings settings;
  settings.exposure_s = 0.00333;
  settings.gain = 20.4;
  const auto read_back = set(settings);
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_ABSOLUTE), 33);
  EXPECT_DOUBLE_EQ(*read_back->exposure_s, 0.0033);
  EXPECT_EQ(read_back->gain, 20.0);
}

TEST_F(VideoControlsTest, RefusesMissingControlsAndValuesOutOfRange) {
  device::CameraSettings settings;
  settings.exposure_s = 1.0;
  EXPECT_THAT(set(settings).error().message,
              HasSubstr("exposure_s is 1, but must be in 0.0001 to 0.5"));
  settings.exposure_s.reset();
  settings.gain = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(set(settings).error().message, HasSubstr("must be in 0 to 63"));
  settings.gain.reset();
  settings.focus = 1.0;
  EXPECT_THAT(set(settings).error().message, HasSubstr("has no control focus"));
  EXPECT_EQ(set(settings).error().code, ErrorCode::kBadOption);
}

TEST_F(VideoControlsTest, ReportsAControlLockedByAnAutomaticMode) {
  fake_->errors[VIDIOC_S_CTRL] = EACCES;
  fake_->controls[V4L2_CID_AUTOGAIN].value = 0;
  const auto failed = set({});
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kBadOption);
  EXPECT_THAT(failed.error().message, HasSubstr("automatic mode"));
}

TEST_F(VideoControlsTest, ReportsWhichControlFailed) {
  fake_->errors[VIDIOC_S_CTRL] = EIO;
  const auto failed = set({});
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(failed.error().message, HasSubstr("does not answer"));
}

}  // namespace
}  // namespace flytri::v4l2
