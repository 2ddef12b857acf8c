/// @file  Asks by which of its inputs a sequencer triggers each camera.
#pragma once

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

/// Sets the triggers of a rig whose light switch can trigger cameras, if all cameras have trigger
/// inputs and the user says that they are wired.
/// @param rig  with cameras and lights
/// @errors  kCancelled: the user stops.
[[nodiscard]] Result<rig::RigSettings> choose_triggers(const rig::RigSettings& rig,
                                                       const SetupContext& context);

}  // namespace flytri::setup
