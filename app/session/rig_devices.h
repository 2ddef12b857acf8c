/// @file  Describes the devices of a rig for the window: their counts and their problems.
#pragma once

#include <string>
#include <vector>

#include "app/session/source.h"
#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"
#include "ui/state/devices_state.h"
#include "ui/text/texts.h"

namespace flytri::session {

/// The settings in rig.json. A calibration given on the command line replaces the one named there.
/// @errors  As read_rig.
[[nodiscard]] Result<rig::RigSettings> chosen_rig(const SourceChoice& choice);

/// Checks the devices of this computer. Takes a moment if one does not answer.
/// @return  the problems that keep the rig from running, each with its remedy; empty: none found
[[nodiscard]] std::vector<std::string> check_chosen_rig(const SourceChoice& choice);

/// The state of each device of the rig. The caller adds the problems.
[[nodiscard]] std::vector<ui::DeviceState> device_states(const rig::RigSettings& rig,
                                                         const rig::RigStatus& status,
                                                         const ui::Texts& texts = {});

}  // namespace flytri::session
