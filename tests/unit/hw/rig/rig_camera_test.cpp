#include "hw/rig/rig_camera.h"

#include <gtest/gtest.h>

namespace flytri::rig {
namespace {

// A camera at 10 Hz; the test sets the faults in its status.
class FaultyCamera final : public device::Camera {
 public:
  Result<void> start() override {
    status_ = {};
    return {};
  }
  void stop() override {}
  Result<std::optional<device::CameraFrame>> next(double /*timeout_s*/) override {
    device::CameraFrame frame;
    frame.image = cv::Mat(64, 64, CV_8UC1, cv::Scalar(10));
    frame.time_s = 100.0 + 0.1 * static_cast<double>(taken_++);
    frame.damaged = is_damaged;
    return frame;
  }
  [[nodiscard]] device::CameraStatus status() const override { return status_; }
  [[nodiscard]] device::CameraSettings requested() const override { return read_back(); }
  [[nodiscard]] device::CameraSettings read_back() const override {
    device::CameraSettings settings;
    settings.rate_hz = 10.0;
    return settings;
  }
  [[nodiscard]] std::string name() const override { return "faulty camera"; }

  device::CameraStatus& faults() { return status_; }
  bool is_damaged = false;

 private:
  device::CameraStatus status_;
  std::int64_t taken_ = 0;
};

class RigCameraReaderTest : public ::testing::Test {
 protected:
  RigCameraReaderTest() { EXPECT_TRUE(reader_.start()); }

  // Whether the exposure times are learned.
  [[nodiscard]] bool knows_exposure_times() {
    constexpr double kTime_s = 200.03;
    return reader_.labeler().timing().clock.next_stamp_s(kTime_s) != kTime_s;
  }
  void label_some() {
    for (int i = 0; i < 10; ++i) (void)reader_.label(*reader_.next(0.0).value());
  }

  std::shared_ptr<FaultyCamera> camera_ = std::make_shared<FaultyCamera>();
  RigCameraReader reader_{camera_, 0.0};
};

TEST_F(RigCameraReaderTest, CountsAndSkipsDamagedFrames) {
  camera_->is_damaged = true;
  EXPECT_FALSE(reader_.next(0.0).value());
  camera_->is_damaged = false;
  EXPECT_TRUE(reader_.next(0.0).value());
  EXPECT_EQ(reader_.status().damaged, 1);
}

// After a restart, the exposures begin at other times than before.
TEST_F(RigCameraReaderTest, LearnsTheExposureTimesAgainAfterEachRestart) {
  for (std::int64_t device::CameraStatus::*count :
       {&device::CameraStatus::returned, &device::CameraStatus::restarted}) {
    label_some();
    EXPECT_TRUE(knows_exposure_times());
    ++(camera_->faults().*count);
    EXPECT_TRUE(reader_.next(0.0).value());
    EXPECT_FALSE(knows_exposure_times());
  }
  label_some();
  EXPECT_TRUE(knows_exposure_times());
}

}  // namespace
}  // namespace flytri::rig
