/// @file  Finds out which camera is which, and settings with which they run together.
#pragma once

#include <optional>

#include "hw/rig/rig_settings.h"
#include "hw/setup/setup_machine.h"

namespace flytri::setup {

struct ChosenCameras {
  rig::RigCamera measurement;
  std::optional<rig::RigCamera> texture;
};

/// Asks the user to cover the measurement camera with a hand: its image gets dark. If only one
/// camera is monochrome, it is suggested first. The texture camera gets the best settings with
/// which both cameras keep their rates.
/// @errors  kNotFound: no camera can be used, and why; kCancelled; of the cameras.
[[nodiscard]] Result<ChosenCameras> choose_cameras(const SetupContext& context);

}  // namespace flytri::setup
