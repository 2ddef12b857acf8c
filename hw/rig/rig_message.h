/// @file  What a user is told of a rig: what is wrong with its devices, and the remedy.
#pragma once

#include <string>

#include "hw/rig/rig_sensor.h"

namespace flytri::rig {

/// Empty where nothing is wrong.
/// @param texture_failure  why the texture camera is gone for good; empty: it is not
[[nodiscard]] std::string rig_message(const RigStatus& status, const std::string& texture_failure);

/// The counts in one line, for a progress line or a panel.
[[nodiscard]] std::string rig_summary(const RigStatus& status);

}  // namespace flytri::rig
