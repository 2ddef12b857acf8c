/// @file  What a rig is made of: which devices, how they are set, what hangs on which line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "hw/device/camera.h"
#include "hw/gpio/light_wiring.h"

namespace flytri::rig {

struct RigCamera {
  device::CameraMatch match;  ///< something of it must be given
  device::CameraSettings settings;
  /// >= 0, by which the last row of a rolling shutter is exposed later than the first; 0: global.
  double readout_s = 0.0;
  [[nodiscard]] Result<void> validate() const;
};

struct RigSettings {
  std::string name = "rig";          ///< what a user calls it
  RigCamera measurement;             ///< grey
  std::optional<RigCamera> texture;  ///< color; needs a flash
  gpio::LightWiring lights;
  double flash_period_s = 1.0;                       ///< > 0, about every second in the paper
  std::optional<std::filesystem::path> calibration;  ///< of this sensor
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace flytri::rig
