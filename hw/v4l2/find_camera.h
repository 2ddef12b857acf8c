/// @file  Finds and lists cameras, with their abilities and problems.
#pragma once

#include <vector>

#include "hw/device/camera.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

/// The device file that delivers the images of the matching camera.
/// @errors  kNotFound, with the available cameras; kInconsistent: several cameras match
[[nodiscard]] Result<device::DeviceNode> find_camera(VideoSystem& system,
                                                     const device::CameraMatch& match);

/// All cameras, including those that cannot be used.
[[nodiscard]] std::vector<device::CameraDescription> list_cameras(VideoSystem& system);

/// Problems that would keep the camera from running with these settings, as far as they can be
/// found without starting it.
[[nodiscard]] std::vector<Error> check_camera(VideoSystem& system, const device::CameraMatch& match,
                                              const device::CameraSettings& settings);

}  // namespace flytri::v4l2
