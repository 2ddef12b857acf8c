/// @file  Sets the exposures of a rig by what its cameras see.
#pragma once

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

/// Exposes a white sheet under each light, so that the lines, or the sheet under the flash, reach
/// 70 % of full scale. The measurement camera is exposed for at most 45 % of a frame, so that the
/// lights can change between two frames; the texture camera for at most half of a frame. Says where
/// a light is too weak for that, or too bright.
/// @param rig  with cameras and lights
/// @return  the rig with exposures
/// @errors  kCancelled; of the devices.
[[nodiscard]] Result<rig::RigSettings> set_exposures(const rig::RigSettings& rig,
                                                     const SetupContext& context);

}  // namespace flytri::setup
