/// @file  Creates the sensor of a rig from its settings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"

namespace flytri::rig {

/// Opens no device before start().
/// @errors  kBadOption; as read_calibration, if the rig names a calibration.
[[nodiscard]] Result<std::shared_ptr<Rig>> open_rig(const RigSettings& rig);

/// Creates the cameras, without triggers, and the light switch; opens none of them.
/// @errors  kBadOption.
[[nodiscard]] Result<RigDevices> open_devices(const RigSettings& rig);

/// Uses devices of the caller, for tests and simulated rigs.
/// @param rig  not triggered
/// @errors  As open_rig.
[[nodiscard]] Result<std::shared_ptr<RigSensor>> assemble_rig(const RigSettings& rig,
                                                              RigDevices devices);

}  // namespace flytri::rig
