/// @file  Reads a camera on its own thread.
#pragma once

#include <memory>

#include "hw/device/camera.h"

namespace flytri::device {

/// Wraps a camera and reads it on its own thread. Setting up a camera takes some tenths of a
/// second, decoding an image some milliseconds. With this class, a caller that reads two cameras
/// loses no frame of the other one meanwhile.
///
/// Frames and states come in their original order: the status belongs to the frame that next()
/// returned last. If the caller is slow, frames stay in the driver; frames that find no free buffer
/// there are counted as dropped.
class ThreadedCamera final : public Camera {
 public:
  explicit ThreadedCamera(std::unique_ptr<Camera> camera);
  ~ThreadedCamera() override;

  [[nodiscard]] Result<void> start() override;
  /// Waits until the camera's current call has returned.
  void stop() override;
  [[nodiscard]] Result<std::optional<CameraFrame>> next(double timeout_s) override;
  [[nodiscard]] CameraStatus status() const override;
  [[nodiscard]] CameraSettings requested() const override { return camera_->requested(); }
  [[nodiscard]] CameraSettings read_back() const override { return camera_->read_back(); }
  [[nodiscard]] std::string name() const override { return camera_->name(); }

 private:
  struct Readings;
  void read();

  const std::unique_ptr<Camera> camera_;
  const std::unique_ptr<Readings> readings_;
};

}  // namespace flytri::device
