/// @file  Leads from devices that are plugged in to a rig.json that works.
#pragma once

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

/// Finds cameras and lights, sets exposures, runs all of it and measures rate and latency. Tells
/// what is wrong, and what to do.
/// @return  the rig; its name is `name`
/// @errors  kCancelled: the user stops; kNotFound: something is missing; of the devices.
[[nodiscard]] Result<rig::RigSettings> run_setup(const std::string& name,
                                                 const SetupContext& context);

}  // namespace flytri::setup
