/// @file  Finds out which line of a GPIO chip switches which light.
#pragma once

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

/// Turns on one line after the other, and asks what lit up. What the measurement camera saw is
/// suggested as the answer. Each light is on for a moment, within the usual limits.
/// @param has_texture  a flash is needed, too
/// @return  without a flash, the user goes on without texture
/// @errors  kNotFound: there is no chip with free lines, or no line switches a pattern;
///          kCancelled; of the devices.
[[nodiscard]] Result<gpio::LightWiring> find_lights(const rig::RigCamera& measurement,
                                                    bool has_texture, const SetupContext& context);

}  // namespace flytri::setup
