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

TEST_F(VideoControlsTest, ControlsThatBendTheImageGetNeutralValues) {
  constexpr std::uint32_t kPrivate = V4L2_CID_PRIVATE_BASE;
  fake_->controls[V4L2_CID_GAMMA] = {72, 500, 220, 220, "Gamma"};
  fake_->controls[V4L2_CID_CONTRAST] = {0, 95, 80, 32, "Contrast"};
  fake_->controls[V4L2_CID_SHARPNESS] = {1, 7, 5, 2, "Sharpness"};
  fake_->controls[V4L2_CID_BACKLIGHT_COMPENSATION] = {0, 2, 1, 1, "Backlight Compensation"};
  fake_->controls[V4L2_CID_POWER_LINE_FREQUENCY] = {0, 2, 1, 1, "Power Line Frequency"};
  fake_->controls[kPrivate] = {0, 3, 3, 3, "3D Noise Reduction"};
  fake_->controls[kPrivate + 1] = {0, 9, 4, 0, "LED"};
  const auto read_back = set({});
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(value(V4L2_CID_GAMMA), 100);
  EXPECT_EQ(value(V4L2_CID_CONTRAST), 32);
  EXPECT_EQ(value(V4L2_CID_SHARPNESS), 1);
  EXPECT_EQ(value(V4L2_CID_BACKLIGHT_COMPENSATION), 0);
  EXPECT_EQ(value(V4L2_CID_POWER_LINE_FREQUENCY), 0);
  EXPECT_EQ(value(kPrivate), 0);
  EXPECT_EQ(value(kPrivate + 1), 4) << "does not bend the image";
  EXPECT_EQ(read_back->controls.at("gamma"), 100.0);
  EXPECT_EQ(read_back->controls.at("3D Noise Reduction"), 0.0);
}

TEST_F(VideoControlsTest, SetsAnyControlByName) {
  fake_->controls[V4L2_CID_GAMMA] = {72, 500, 220, 220, "Gamma"};
  fake_->controls[V4L2_CID_PRIVATE_BASE] = {0, 9, 4, 0, "LED"};
  device::CameraSettings settings;
  settings.controls = {{"gamma", 120.0}, {"LED", 0.0}};
  const auto read_back = set(settings);
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(value(V4L2_CID_GAMMA), 120);
  EXPECT_EQ(value(V4L2_CID_PRIVATE_BASE), 0);
  EXPECT_EQ(read_back->controls.at("LED"), 0.0);
  settings.controls = {{"gamma", 600.0}};
  EXPECT_THAT(set(settings).error().message, HasSubstr("must be in 72 to 500"));
  settings.controls = {{"gama", 100.0}};
  EXPECT_THAT(set(settings).error().message, HasSubstr("no control \"gama\""));
  EXPECT_THAT(set(settings).error().message, HasSubstr("gamma"));
}

TEST_F(VideoControlsTest, KeepsACameraThatRefusesANeutralValue) {
  fake_->controls[V4L2_CID_EXPOSURE_AUTO].value = V4L2_EXPOSURE_MANUAL;
  fake_->controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY].value = 0;
  fake_->controls[V4L2_CID_AUTOGAIN].value = 0;
  fake_->controls[V4L2_CID_SHARPNESS] = {0, 7, 5, 2, "Sharpness"};
  fake_->errors[VIDIOC_S_CTRL] = EINVAL;
  const auto read_back = set({});
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(read_back->controls.at("sharpness"), 5.0);
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
