/// @file  Sets up an opened camera by its GenICam features.
#pragma once

#include <string>
#include <vector>

#include "hw/device/camera.h"
#include "hw/genicam/aravis.h"

namespace flytri::genicam {

/// An opened camera, and its label for messages. Not owned.
struct OpenCamera {
  ArvCamera& camera;
  const std::string& label;
};

/// Sets format, size, rate, exposure, gain and trigger. Turns off automatic modes, sharpness and
/// noise filters, and sets gamma to 1. The image is taken from the middle of the chip.
/// @return  the settings read back; missing controls have no value
/// @errors  kBadOption: unsupported format, size or control, or out of range; else as
///          ArvFailure::told
[[nodiscard]] Result<device::CameraSettings> set_up(const OpenCamera& open,
                                                    const device::CameraSettings& settings);

/// Checks formats, sizes and controls, without setting them.
/// @errors  As set_up.
[[nodiscard]] Result<void> check_settings(const OpenCamera& open,
                                          const device::CameraSettings& settings);

/// Each supported format with the size of the whole chip, and the ends of the range of rates.
[[nodiscard]] std::vector<device::CameraMode> list_modes(ArvCamera& camera);
/// What can trigger the camera from outside: its inputs, without triggers by software.
[[nodiscard]] std::vector<std::string> list_trigger_inputs(ArvCamera& camera);
/// Exposure, gain and the controls that rig.json can name, as far as the camera has them.
[[nodiscard]] std::vector<device::CameraControl> list_controls(ArvCamera& camera);

}  // namespace flytri::genicam
