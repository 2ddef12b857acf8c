#include "hw/rig/triggered_camera.h"

#include <gmock/gmock.h>

#include <deque>
#include <memory>

namespace flytri::rig {
namespace {

constexpr double kPeriod_s = 0.025;
constexpr double kStamp_s = 0.009;     ///< from an exposure to the time in its image
constexpr double kTransfer_s = 0.060;  ///< from an exposure to the arrival of its image

/// Takes an image of each exposure. The image shows the light.
class ExposedCamera final : public device::Camera {
 public:
  Result<void> start() override { return {}; }
  void stop() override {}
  Result<std::optional<device::CameraFrame>> next(double) override {
    if (coming_.empty() || now_s < coming_.front().time_s - kStamp_s + kTransfer_s)
      return std::nullopt;
    const device::CameraFrame frame = coming_.front();
    coming_.pop_front();
    return frame;
  }
  device::CameraStatus status() const override { return {}; }
  device::CameraSettings requested() const override { return {}; }
  device::CameraSettings read_back() const override { return {}; }
  std::string name() const override { return "exposed camera"; }

  void expose(device::Light light) {
    device::CameraFrame frame;
    frame.image = cv::Mat(2, 2, CV_8UC1, cv::Scalar(static_cast<int>(light)));
    frame.time_s = now_s + kStamp_s;
    frame.sequence = sequence_++;
    coming_.push_back(frame);
  }

  double now_s = 10.0;

 private:
  std::int64_t sequence_ = 7;
  std::deque<device::CameraFrame> coming_;
};

class TriggeredCameraTest : public ::testing::Test {
 protected:
  TriggeredCameraTest() { EXPECT_TRUE(camera_.start()); }

  /// For so many seconds triggers and reads as a sensor does, with the two patterns in turn.
  void run(double seconds) {
    for (const double end_s = device_->now_s + seconds; device_->now_s < end_s;) {
      if (device_->now_s >= next_s_ && camera_.takes_trigger(device_->now_s)) {
        next_s_ = device_->now_s + kPeriod_s;
        light_ = light_ == device::Light::kVertical ? device::Light::kHorizontal
                                                    : device::Light::kVertical;
        device_->expose(light_);
        camera_.triggered(light_, device_->now_s);
      }
      const auto image = camera_.next(0.0);
      ASSERT_TRUE(image);
      if (*image) {
        ++labeled_;
        if ((*image)->image.at<std::uint8_t>(0, 0) != static_cast<int>((*image)->light)) ++wrong_;
      }
      device_->now_s += 0.001;
    }
  }

  std::shared_ptr<ExposedCamera> device_ = std::make_shared<ExposedCamera>();
  TriggeredCamera camera_{device_, kPeriod_s};
  device::Light light_ = device::Light::kHorizontal;
  double next_s_ = 0.0;
  int labeled_ = 0, wrong_ = 0;
};

TEST_F(TriggeredCameraTest, LabelsEachImageWithItsLight) {
  run(2.0);
  EXPECT_GT(labeled_, 60);
  EXPECT_EQ(wrong_, 0);
}

/// A sequencer that hung exposes later what it was told before. Such an image could pass for that
/// of the next trigger.
TEST_F(TriggeredCameraTest, ImagesOfExposuresThatItDidNotAskForGetNoLabel) {
  for (int others = 1; others <= 3; ++others) {
    for (int gap_ms = 0; gap_ms <= 60; gap_ms += 5) {
      run(1.0);
      for (int i = 0; i < others; ++i) {
        device_->expose(device::Light::kFlash);
        device_->now_s += 1e-3 * gap_ms;
      }
      camera_.begin_anew();
      labeled_ = 0;
      run(1.0);
      ASSERT_EQ(wrong_, 0) << others << " images, " << gap_ms << " ms";
      EXPECT_GT(labeled_, 10) << others << " images, " << gap_ms << " ms";
    }
  }
}

}  // namespace
}  // namespace flytri::rig
