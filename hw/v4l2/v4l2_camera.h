/// @file  A camera driven through V4L2. Finds, configures and streams it, and reconnects when it
/// was unplugged.
#pragma once

#include <memory>
#include <mutex>

#include "hw/device/camera.h"
#include "hw/device/clock.h"
#include "hw/v4l2/frame_stamper.h"
#include "hw/v4l2/video_stream.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

struct V4l2CameraOptions {
  /// 2..32. Frames that the driver buffers while the reader is busy; 8 are a quarter of a second at
  /// 30 Hz.
  int buffers = 8;
  /// > 1. Frame periods without a frame after which the camera counts as frozen.
  double frozen_after_periods = 5.0;
  /// > 0. A frozen camera that sends nothing for this time is restarted, which often helps.
  double restart_after_s = 2.0;
  /// > 0. Time between searches for a lost camera; setting up a camera takes about as long.
  double search_period_s = 0.25;
  [[nodiscard]] Result<void> validate() const;
};

/// System calls and clock of a camera; tests replace them.
struct V4l2Environment {
  std::shared_ptr<VideoSystem> system = kernel_video_system();
  device::Clock clock = device::machine_clock();
};

class V4l2Camera final : public device::Camera {
 public:
  /// Opens no device before start().
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<V4l2Camera>> create(
      device::CameraMatch match, const device::CameraSettings& settings,
      const V4l2CameraOptions& options = {}, V4l2Environment environment = {});

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<device::CameraFrame>> next(double timeout_s) override;
  [[nodiscard]] device::CameraStatus status() const override;
  [[nodiscard]] device::CameraSettings requested() const override { return requested_; }
  [[nodiscard]] device::CameraSettings read_back() const override;
  [[nodiscard]] std::string name() const override;

 private:
  V4l2Camera(device::CameraMatch match, const device::CameraSettings& settings,
             const V4l2CameraOptions& options, V4l2Environment environment);
  [[nodiscard]] Result<void> open();
  void search(double timeout_s);
  void reopened();
  void ended(const StreamEnd& end);
  void watch_for_frames(double now_s);
  [[nodiscard]] device::CameraFrame enter(const StreamedImage& image);

  const device::CameraMatch match_;
  const device::CameraSettings requested_;
  const V4l2CameraOptions options_;
  const V4l2Environment environment_;

  // Used only by the reading thread.
  std::unique_ptr<VideoStream> stream_;
  FrameStamper frame_stamper_;
  double last_arrival_s_ = 0.0;  // of a frame, or since the stream began
  double next_search_s_ = 0.0;
  int learned_bits_ = 0;  // of Y16; 0: nothing yet
  bool away_ = false;     // the device is unplugged, not only its stream broken

  mutable std::mutex mutex_;  // guards all members below
  device::CameraStatus status_;
  device::CameraSettings read_back_;
  std::string name_;
};

}  // namespace flytri::v4l2
