/// @file  A camera of the machine, through V4L2: found, set up, streamed, and found again.
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
  /// 2..32 frames that the driver holds while the reader is busy: a quarter of a second at 30 Hz.
  int buffers = 8;
  /// > 1, of frames: so long none comes before the camera counts as frozen.
  double frozen_after_periods = 5.0;
  /// > 0. A camera that is frozen and has sent nothing for so long is set up anew: many go on then.
  double restart_after_s = 2.0;
  /// > 0. So often a camera that is lost is looked for. Setting one up takes about as long.
  double search_period_s = 0.25;
  [[nodiscard]] Result<void> validate() const;
};

/// What a camera runs on; tests put their own in its place.
struct VideoMeans {
  std::shared_ptr<VideoSystem> system = kernel_video_system();
  device::Clock clock = device::machine_clock();
};

class V4l2Camera final : public device::Camera {
 public:
  /// Nothing is opened before start().
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<V4l2Camera>> create(
      device::CameraMatch match, const device::CameraSettings& settings,
      const V4l2CameraOptions& options = {}, VideoMeans means = {});

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<device::CameraFrame>> next(double timeout_s) override;
  [[nodiscard]] device::CameraStatus status() const override;
  [[nodiscard]] device::CameraSettings asked() const override { return asked_; }
  [[nodiscard]] device::CameraSettings read_back() const override;
  [[nodiscard]] std::string name() const override;

 private:
  V4l2Camera(device::CameraMatch match, const device::CameraSettings& settings,
             const V4l2CameraOptions& options, VideoMeans means);
  [[nodiscard]] Result<void> open();
  void search(double timeout_s);
  void reopened();
  void ended(const StreamEnd& end);
  void watch_for_frames(double now_s);
  [[nodiscard]] device::CameraFrame enter(const StreamedImage& image);

  const device::CameraMatch match_;
  const device::CameraSettings asked_;
  const V4l2CameraOptions options_;
  const VideoMeans means_;

  // Of the thread that reads.
  std::unique_ptr<VideoStream> stream_;
  FrameStamper frame_stamper_;
  double last_arrival_s_ = 0.0;  // of a frame, or since the stream began
  double next_search_s_ = 0.0;
  bool away_ = false;  // the device, not just its stream

  mutable std::mutex mutex_;  // of all below
  device::CameraStatus status_;
  device::CameraSettings read_back_;
  std::string name_;
};

}  // namespace flytri::v4l2
