/// @file  The rig of the virtual machine: emulated cameras and chip of tests/hardware/usb.
#pragma once

#include <filesystem>
#include <optional>

#include "hw/rig/rig_settings.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::scan {

/// Rate of both cameras. The guest is slow: the hand is simulated at 30 Hz, six times as fast.
inline constexpr double kRate_hz = 5.0;
inline constexpr double kFlashPeriod_s = 4.0;

[[nodiscard]] rig::RigSettings vm_rig(const simulated::SensorModel& sensor,
                                      const std::optional<std::filesystem::path>& calibration);

}  // namespace flytri::scan
