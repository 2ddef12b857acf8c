/// @file  Asks by which of its inputs a sequencer triggers each camera.
#pragma once

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

/// Asks the user which inputs are wired.
/// @param rig  with cameras and lights
/// @return  the rig with triggers; unchanged without a sequencer, a trigger input or a wire
/// @errors  kCancelled: the user stops.
[[nodiscard]] Result<rig::RigSettings> choose_triggers(const rig::RigSettings& rig,
                                                       const SetupContext& context);

}  // namespace flytri::setup
