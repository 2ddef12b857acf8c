/// @file  Finds problems of a rig without starting it.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "hw/gpio/gpio_chips.h"
#include "hw/rig/rig_settings.h"

namespace flytri::rig {

/// @param chips  the GPIO chips of this machine
/// @return  each problem, with what to do about it; empty if none was found
[[nodiscard]] std::vector<Error> check_rig(const RigSettings& rig, const CameraDrivers& drivers,
                                           const std::vector<gpio::GpioChip>& chips);

}  // namespace flytri::rig
