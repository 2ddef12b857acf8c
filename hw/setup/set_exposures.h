/// @file  Sets the exposures of a rig by what its cameras see.
#pragma once

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

/// Exposes a white sheet under each light until the brightest places reach 70 % of full scale. At
/// most 45 % of a frame for the measurement camera, so that the lights can change between frames
/// (80 % where it is triggered), and half of a frame for the texture camera. Tells if a light is
/// too weak or too bright.
/// @param rig  with cameras and lights
/// @return  the rig with exposures
/// @errors  kCancelled; of the devices.
[[nodiscard]] Result<rig::RigSettings> set_exposures(const rig::RigSettings& rig,
                                                     const SetupContext& context);

}  // namespace flytri::setup
