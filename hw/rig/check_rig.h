/// @file  What would keep a rig from running, told without starting it.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "hw/gpio/gpio_chips.h"
#include "hw/rig/rig_settings.h"
#include "hw/v4l2/video_system.h"

namespace flytri::rig {

/// @param chips  those that there are
/// @return  each problem with its remedy; empty: nothing that can be told
[[nodiscard]] std::vector<Error> check_rig(const RigSettings& rig, v4l2::VideoSystem& system,
                                           const std::vector<gpio::GpioChip>& chips);

}  // namespace flytri::rig
