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

/// Asks the user to hold a hand in front of the measurement camera: its image gets dark. Where one
/// camera is monochrome and all others are not, it is suggested at once. The texture camera gets
/// the best settings with which both cameras keep their rates.
/// @errors  kNotFound: no camera can be used, and why; kCancelled; of the cameras.
[[nodiscard]] Result<ChosenCameras> choose_cameras(const SetupContext& context);

}  // namespace flytri::setup
