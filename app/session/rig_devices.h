/// @file  A rig in the user's words: what its devices count and what is wrong with them.
#pragma once

#include <string>
#include <vector>

#include "app/session/source.h"
#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"
#include "ui/state/devices_state.h"

namespace flytri::session {

/// The settings that the user chose: the rig.json, with the calibration named on the command line
/// in place of its own.
/// @errors  As read_rig.
[[nodiscard]] Result<rig::RigSettings> chosen_rig(const SourceChoice& choice);

/// Looks at the devices of this machine; takes a moment where one does not answer.
/// @return  what keeps the rig from running, each with its remedy; empty: nothing that can be told
[[nodiscard]] std::vector<std::string> check_chosen_rig(const SourceChoice& choice);

/// A card for each device of the rig; problems are the caller's.
[[nodiscard]] std::vector<ui::DeviceState> device_states(const rig::RigSettings& rig,
                                                         const rig::RigStatus& status);

}  // namespace flytri::session
