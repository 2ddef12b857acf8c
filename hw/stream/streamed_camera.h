/// @file  A camera made of its stream: notices when frames stop, restarts it, and reconnects when
/// it was unplugged.
#pragma once

#include <memory>
#include <mutex>

#include "hw/device/camera.h"
#include "hw/device/clock.h"
#include "hw/stream/camera_driver.h"
#include "hw/stream/frame_stamper.h"

namespace flytri::stream {

struct StreamedCameraOptions {
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

class StreamedCamera final : public device::Camera {
 public:
  /// Opens no device before start().
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<StreamedCamera>> create(
      std::shared_ptr<CameraDriver> driver, const device::CameraMatch& match,
      const device::CameraSettings& settings, const StreamedCameraOptions& options = {},
      const device::Clock& clock = device::machine_clock());

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<device::CameraFrame>> next(double timeout_s) override;
  [[nodiscard]] device::CameraStatus status() const override;
  [[nodiscard]] device::CameraSettings requested() const override { return requested_; }
  [[nodiscard]] device::CameraSettings read_back() const override;
  [[nodiscard]] std::string name() const override;

 private:
  StreamedCamera(std::shared_ptr<CameraDriver> driver, device::CameraMatch match,
                 const device::CameraSettings& settings, const StreamedCameraOptions& options,
                 device::Clock clock);
  [[nodiscard]] Result<void> open();
  void search(double timeout_s);
  void reopened();
  void ended(const StreamEnd& end);
  void watch_for_frames(double now_s);
  [[nodiscard]] device::CameraFrame enter(const StreamedImage& image);

  const std::shared_ptr<CameraDriver> driver_;
  const device::CameraMatch match_;
  const device::CameraSettings requested_;
  const StreamedCameraOptions options_;
  const device::Clock clock_;

  // Used only by the reading thread.
  std::unique_ptr<ImageStream> stream_;
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

}  // namespace flytri::stream
