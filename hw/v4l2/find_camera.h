/// @file  Which cameras there are, what they can do, and what keeps them from being used.
#pragma once

#include <vector>

#include "hw/device/camera.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

/// The device file that gives the images of the one camera that is meant.
/// @errors  kNotFound with those that there are; kInconsistent: several match
[[nodiscard]] Result<device::DeviceNode> find_camera(VideoSystem& system,
                                                     const device::CameraMatch& match);

/// Every camera, those that cannot be used among them.
[[nodiscard]] std::vector<device::CameraDescription> list_cameras(VideoSystem& system);

/// What would keep the camera from running so; empty: nothing that can be told without starting it.
[[nodiscard]] std::vector<Error> check_camera(VideoSystem& system, const device::CameraMatch& match,
                                              const device::CameraSettings& settings);

}  // namespace flytri::v4l2
