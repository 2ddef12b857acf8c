/// @file  From the settings of a rig to a sensor made of the devices of this machine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"

namespace flytri::rig {

/// No device is opened before start().
/// @errors  kBadOption; as read_calibration, where the rig names one.
[[nodiscard]] Result<std::shared_ptr<RigSensor>> open_rig(const RigSettings& rig);

/// The cameras and lights alone; none is opened yet.
/// @errors  kBadOption.
[[nodiscard]] Result<RigDevices> open_devices(const RigSettings& rig);

/// With devices of the caller's, for tests and for simulated rigs.
/// @errors  As open_rig.
[[nodiscard]] Result<std::shared_ptr<RigSensor>> assemble_rig(const RigSettings& rig,
                                                              RigDevices devices);

}  // namespace flytri::rig
