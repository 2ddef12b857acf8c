/// @file  The rig of the virtual machine: cameras and a chip of tests/hardware/usb.
#pragma once

#include <filesystem>
#include <optional>

#include "hw/rig/rig_settings.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::scan {

/// Of both cameras. The guest is slow: its clock has six ticks for one of the hand's.
inline constexpr double kRate_hz = 5.0;
inline constexpr double kFlashPeriod_s = 4.0;

[[nodiscard]] rig::RigSettings vm_rig(const simulated::SensorModel& sensor,
                                      const std::optional<std::filesystem::path>& calibration);

}  // namespace flytri::scan
