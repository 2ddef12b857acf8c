/// @file  Status messages of a rig: what is wrong with its devices, and what to do.
#pragma once

#include <string>

#include "hw/rig/rig.h"

namespace flytri::rig {

/// Empty if nothing is wrong.
/// @param texture_failure  why the texture camera failed permanently; empty if it did not
[[nodiscard]] std::string rig_message(const RigStatus& status, const std::string& texture_failure);

/// The counts in one line, for a progress line or a panel.
[[nodiscard]] std::string rig_summary(const RigStatus& status);

}  // namespace flytri::rig
