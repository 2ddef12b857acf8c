/// @file  Puts what the user chose in the desktop's file chooser into its field.
#pragma once

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Call once a frame. A new case gets the ending of cases if it was left out.
void take_chosen_path(const AppView& view, WindowState& state);

}  // namespace flytri::ui
