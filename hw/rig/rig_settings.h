/// @file  Settings of a rig: its devices, their settings, and the wiring of the lights.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "hw/device/camera.h"
#include "hw/gpio/light_wiring.h"
#include "hw/rig/camera_drivers.h"

namespace flytri::rig {

struct RigCamera {
  DriverKind driver = DriverKind::kV4l2;
  device::CameraMatch match;  ///< at least one field must be given
  device::CameraSettings settings;
  /// >= 0. Delay between the exposures of the first and the last row (rolling shutter); 0: global
  /// shutter.
  double readout_s = 0.0;
  [[nodiscard]] Result<void> validate() const;
};

struct RigSettings {
  std::string name = "rig";          ///< name shown to the user
  RigCamera measurement;             ///< grey
  std::optional<RigCamera> texture;  ///< color; needs a flash
  gpio::LightWiring lights;
  double flash_period_s = 1.0;                       ///< > 0; about 1 s in the paper
  std::optional<std::filesystem::path> calibration;  ///< of this sensor
  /// Whether the light switch triggers the cameras; then it is a sequencer.
  [[nodiscard]] bool is_triggered() const;
  /// The same rig with cameras that need no triggers: for calibration shots and checks.
  [[nodiscard]] RigSettings free_running() const;
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace flytri::rig
