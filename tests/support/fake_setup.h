/// @file  States of a setup for the window, without devices.
#pragma once

#include "ui/state/setup_state.h"

namespace flytri::testing {

[[nodiscard]] ui::RunningSetup fake_setup(ui::SetupStep step);

}  // namespace flytri::testing
