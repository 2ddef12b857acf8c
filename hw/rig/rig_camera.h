/// @file  One camera of a rig with the labels of its frames.
#pragma once

#include <memory>
#include <optional>

#include "hw/device/camera.h"
#include "hw/sync/frame_labeler.h"

namespace flytri::rig {

/// What became of the frames of a camera, and what is known of its latency.
struct RigCameraStatus {
  device::CameraStatus camera;
  sync::LabelCounts labels;
  std::int64_t damaged = 0;  ///< not looked at: the driver flagged them, or they are not whole
  sync::LatencyEstimate latency;
  bool is_learned = false;  ///< the latency
  sync::LightFault fault = sync::LightFault::kNone;
};

/// start, stop and next are called from one thread, all else from that one, too.
class RigCameraReader {
 public:
  /// @param readout_s  see RigCamera
  RigCameraReader(std::shared_ptr<device::Camera> camera, double readout_s)
      : camera_(std::move(camera)), readout_s_(readout_s) {}

  /// @errors  As Camera::start; kBadOption.
  [[nodiscard]] Result<void> start();
  void stop() { camera_->stop(); }

  /// The next frame that is whole; nothing: none yet, or a damaged one.
  /// @errors  As Camera::next.
  [[nodiscard]] Result<std::optional<device::CameraFrame>> next(double timeout_s);
  /// Once the labeler has heard of all that was switched before the frame came.
  [[nodiscard]] sync::FrameLabel label(const device::CameraFrame& frame) {
    return labeler_->label(frame.image, frame.time_s);
  }

  /// Once started.
  [[nodiscard]] sync::FrameLabeler& labeler() { return *labeler_; }
  [[nodiscard]] RigCameraStatus status() const;
  [[nodiscard]] device::CameraState state() const { return camera_->status().state; }

 private:
  std::shared_ptr<device::Camera> camera_;
  double readout_s_;
  std::optional<sync::FrameLabeler> labeler_;
  std::int64_t damaged_ = 0;
  std::int64_t streams_ = 0;  // begun since the first one, as far as the labeler knows
};

}  // namespace flytri::rig
