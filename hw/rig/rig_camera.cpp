#include "hw/rig/rig_camera.h"

#include <utility>

namespace flytri::rig {

Result<void> RigCameraReader::start() {
  if (auto started = camera_->start(); !started) return started;
  const device::CameraSettings settings = camera_->read_back();
  sync::LabelerOptions options;
  options.clock.period_s = 1.0 / settings.rate_hz;
  options.latency.min_window_s = settings.exposure_s.value_or(0.0) + readout_s_;
  auto labeler = sync::FrameLabeler::create(options);
  if (!labeler) {
    camera_->stop();
    return tl::unexpected(labeler.error());
  }
  labeler_ = *std::move(labeler);
  damaged_ = streams_ = 0;
  return {};
}

Result<std::optional<device::CameraFrame>> RigCameraReader::next(double timeout_s) {
  auto frame = camera_->next(timeout_s);
  if (!frame) return tl::unexpected(frame.error());
  const device::CameraStatus status = camera_->status();
  const std::int64_t streams = status.returned + status.restarted;
  if (std::exchange(streams_, streams) != streams) labeler_->camera_returned();
  if (!*frame) return std::nullopt;
  if ((*frame)->damaged) {
    ++damaged_;
    return std::nullopt;
  }
  return frame;
}

RigCameraStatus RigCameraReader::status() const {
  RigCameraStatus status;
  status.camera = camera_->status();
  status.damaged = damaged_;
  if (!labeler_) return status;
  status.labels = labeler_->counts();
  status.latency = labeler_->latency();
  status.is_learned = labeler_->is_learned();
  status.fault = labeler_->fault();
  return status;
}

}  // namespace flytri::rig
