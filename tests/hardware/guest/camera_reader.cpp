#include "tests/hardware/guest/camera_reader.h"

#include "hw/stream/streamed_camera.h"
#include "hw/v4l2/v4l2_driver.h"

namespace flytri::testing {

CameraReader::CameraReader(const device::CameraMatch& match,
                           const device::CameraSettings& settings) {
  auto camera =
      stream::StreamedCamera::create(std::make_shared<v4l2::V4l2Driver>(), match, settings);
  if (!camera) throw std::runtime_error(camera.error().message);
  camera_ = std::move(*camera);
}

void CameraReader::start() {
  const auto started = camera_->start();
  ASSERT_TRUE(started) << started.error().message;
}

void CameraReader::read_one() {
  const auto next = camera_->next(0.05);
  ASSERT_TRUE(next) << next.error().message;
  if (!*next) return;
  frames_.push_back({(*next)->time_s, (*next)->sequence, (*next)->damaged});
  last_image_ = (*next)->image;
}

void CameraReader::read(int frames, double limit_s) {
  const std::size_t goal = frames_.size() + frames;
  read_until([&](const device::CameraStatus&) { return frames_.size() >= goal; }, limit_s);
}

void CameraReader::read_until(const std::function<bool(const device::CameraStatus&)>& wanted,
                              double limit_s) {
  const device::Clock clock = device::machine_clock();
  const double end_s = clock.now_s() + limit_s;
  while (!wanted(camera_->status())) {
    ASSERT_LT(clock.now_s(), end_s)
        << to_string(camera_->status().state) << ": " << camera_->status().message;
    ASSERT_NO_FATAL_FAILURE(read_one());
  }
}

void CameraReader::expect_order() const {
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    EXPECT_GT(frames_[i].time_s, frames_[i - 1].time_s);
    EXPECT_GT(frames_[i].sequence, frames_[i - 1].sequence);
  }
}

}  // namespace flytri::testing
