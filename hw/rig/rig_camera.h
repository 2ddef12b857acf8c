/// @file  Reads one camera of a rig and labels its frames.
#pragma once

#include <memory>
#include <optional>

#include "hw/device/camera.h"
#include "hw/sync/frame_labeler.h"

namespace flytri::rig {

/// Counts of a camera's frames by outcome, and its latency.
struct RigCameraStatus {
  device::CameraStatus camera;
  sync::LabelCounts labels;
  std::int64_t damaged = 0;  ///< frames ignored because they are damaged
  sync::LatencyEstimate latency;
  bool is_learned = false;  ///< whether the latency is known
  sync::LightFault fault = sync::LightFault::kNone;
};

/// Not thread-safe: call all members from one thread.
class RigCameraReader {
 public:
  /// @param readout_s  see RigCamera::readout_s
  RigCameraReader(std::shared_ptr<device::Camera> camera, double readout_s)
      : camera_(std::move(camera)), readout_s_(readout_s) {}

  /// @errors  As Camera::start; kBadOption.
  [[nodiscard]] Result<void> start();
  void stop() { camera_->stop(); }

  /// The next undamaged frame; nothing if there is none yet, or if the next one is damaged.
  /// @errors  As Camera::next.
  [[nodiscard]] Result<std::optional<device::CameraFrame>> next(double timeout_s);
  /// Labels a frame. Report all light switching before the frame's arrival to the labeler first.
  [[nodiscard]] sync::FrameLabel label(const device::CameraFrame& frame) {
    return labeler_->label(frame.image, frame.time_s);
  }

  /// Takes a frame for its time alone: the lights are off on purpose.
  void pass(const device::CameraFrame& frame) { labeler_->pass(frame.time_s); }

  /// Only after start().
  [[nodiscard]] sync::FrameLabeler& labeler() { return *labeler_; }
  [[nodiscard]] RigCameraStatus status() const;
  [[nodiscard]] device::CameraState state() const { return camera_->status().state; }

 private:
  std::shared_ptr<device::Camera> camera_;
  double readout_s_;
  std::optional<sync::FrameLabeler> labeler_;
  std::int64_t damaged_ = 0;
  std::int64_t streams_ = 0;  // stream restarts that the labeler knows of
};

}  // namespace flytri::rig
