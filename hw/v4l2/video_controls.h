/// @file  The controls of a camera: automatic modes off, what is asked set and read back.
#pragma once

#include <vector>

#include "hw/device/camera.h"
#include "hw/v4l2/video_modes.h"

namespace flytri::v4l2 {

/// All numbers, switches and menus that it has.
[[nodiscard]] std::vector<device::CameraControl> list_controls(VideoDevice& device);

/// Turns off what the camera would do by itself, even where nothing else is asked: frames whose
/// exposure wanders cannot be measured. Then sets what is asked.
/// @return  the settings with the controls as they were read back; what it lacks has no value
/// @errors  kBadOption: it lacks a control that is asked for, or its range; else as video_failure
[[nodiscard]] Result<device::CameraSettings> set_controls(const OpenVideo& video,
                                                          const device::CameraSettings& settings);

}  // namespace flytri::v4l2
