/// @file  Controls with which a camera changes the grey values of its image.
#pragma once

#include <map>
#include <string>

#include "hw/v4l2/one_control.h"

namespace flytri::v4l2 {

/// Values by name; see CameraSettings::controls.
using NamedControls = std::map<std::string, double>;

/// Sets the controls that bend the image to the values asked for, and the others to neutral ones:
///
///     gamma                    100 (UVC: hundredths, so linear) if in range, else the default
///     contrast                 the default
///     sharpness                the smallest value
///     backlight_compensation   the smallest value
///     power_line_frequency     off
///     any with "noise" in its name, wide dynamic range: the smallest value
///
/// Controls that the camera lacks are left out.
/// @param wanted  by these names, or by the driver's own name of any control
/// @return  the values of all these controls, read back
/// @errors  kBadOption: no such control, or the value is out of range; else as write_control
[[nodiscard]] Result<NamedControls> set_image_controls(const OpenVideo& video,
                                                       const NamedControls& wanted, WriteMode mode);

}  // namespace flytri::v4l2
