/// @file  Interface of a rig: cameras and lights that together are one sensor.
#pragma once

#include <cstdint>
#include <optional>

#include "hw/device/light_switch.h"
#include "hw/device/sensor.h"
#include "hw/rig/rig_camera.h"

namespace flytri::rig {

/// Counts since start().
struct RigStatus {
  RigCameraStatus measurement;
  std::optional<RigCameraStatus> texture;
  device::LightSwitchStatus lights;
  int frames_per_pattern = 1;
  bool keeps_step = false;  ///< each exposure sees one light
  std::int64_t late = 0;    ///< frames dropped because a later one was already delivered
};

class Rig : public device::Sensor {
 public:
  /// Thread-safe.
  [[nodiscard]] virtual RigStatus rig_status() const = 0;
};

}  // namespace flytri::rig
