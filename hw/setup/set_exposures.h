/// @file  Sets the exposures of a rig by what its cameras see.
#pragma once

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

/// Exposes a white sheet under each light until the brightest places reach 70 % of full scale. The
/// longest exposure of the measurement camera is 45 % of a frame: the rest is for changing the
/// lights. With a trigger it is 80 %. That of the texture camera is half of a frame. Tells if a
/// light is too weak or too bright.
/// @param rig  with cameras and lights
/// @return  the rig with exposures
/// @errors  kCancelled; of the devices.
[[nodiscard]] Result<rig::RigSettings> set_exposures(const rig::RigSettings& rig,
                                                     const SetupContext& context);

}  // namespace flytri::setup
