/// @file  Carries an action out: in the window's own state, or as a command to the program.
#pragma once

#include <vector>

#include "ui/actions/key_map.h"
#include "ui/state/command.h"

namespace flytri::ui {

/// Keys and buttons alike end here. Nothing happens where action_state() says disabled.
void perform(Action action, const AppView& view, WindowState& state,
             std::vector<Command>& commands);

}  // namespace flytri::ui
