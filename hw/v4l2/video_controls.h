/// @file  Lists and sets the controls of a camera.
#pragma once

#include <vector>

#include "hw/device/camera.h"
#include "hw/v4l2/one_control.h"

namespace flytri::v4l2 {

/// All numbers, switches and menus of the camera.
[[nodiscard]] std::vector<device::CameraControl> list_controls(VideoDevice& device);

/// Turns off all automatic modes, then sets the requested values and the controls that bend the
/// image (image_controls.h). Frames with varying exposure cannot be measured.
/// @return  the settings with the values read back; missing controls have no value
/// @errors  kBadOption: the control is missing or the value out of range; else as video_failure
[[nodiscard]] Result<device::CameraSettings> set_controls(const OpenVideo& video,
                                                          const device::CameraSettings& settings,
                                                          WriteMode mode = WriteMode::kIfChanged);

}  // namespace flytri::v4l2
