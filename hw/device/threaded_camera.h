/// @file  A camera that is read beside, so that it holds nobody up.
#pragma once

#include <memory>

#include "hw/device/camera.h"

namespace flytri::device {

/// Reads a camera on a thread of its own. Setting a camera up anew takes some tenths of a second,
/// decoding an image some milliseconds; who waits for another camera meanwhile loses none of its
/// frames.
///
/// Frames and states are those of the camera, in their order, as the reader comes to them: the
/// status belongs to the frame that next() returned last. A reader that lags leaves frames in the
/// driver, where those that find no room are counted as dropped.
class ThreadedCamera final : public Camera {
 public:
  explicit ThreadedCamera(std::unique_ptr<Camera> camera);
  ~ThreadedCamera() override;

  [[nodiscard]] Result<void> start() override;
  /// Waits for what the camera is doing.
  void stop() override;
  [[nodiscard]] Result<std::optional<CameraFrame>> next(double timeout_s) override;
  [[nodiscard]] CameraStatus status() const override;
  [[nodiscard]] CameraSettings asked() const override { return camera_->asked(); }
  [[nodiscard]] CameraSettings read_back() const override { return camera_->read_back(); }
  [[nodiscard]] std::string name() const override { return camera_->name(); }

 private:
  struct Readings;
  void read();

  const std::unique_ptr<Camera> camera_;
  const std::unique_ptr<Readings> readings_;
};

}  // namespace flytri::device
