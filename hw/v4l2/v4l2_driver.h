/// @file  Reaches the cameras of this machine through V4L2.
#pragma once

#include <memory>

#include "hw/stream/camera_driver.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

class V4l2Driver final : public stream::CameraDriver {
 public:
  /// @param system  the system calls; tests replace them
  explicit V4l2Driver(std::shared_ptr<VideoSystem> system = kernel_video_system());

  [[nodiscard]] std::vector<device::CameraDescription> list() override;
  [[nodiscard]] Result<stream::FoundCamera> find(const device::CameraMatch& match) override;
  [[nodiscard]] std::vector<Error> check(const device::CameraMatch& match,
                                         const device::CameraSettings& settings) override;
  [[nodiscard]] Result<std::unique_ptr<stream::ImageStream>> open(
      const device::CameraMatch& match, const device::CameraSettings& settings,
      int buffers) override;

 private:
  const std::shared_ptr<VideoSystem> system_;
};

}  // namespace flytri::v4l2
