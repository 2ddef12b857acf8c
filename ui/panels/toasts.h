/// @file  Which notices show, and for how long.
#pragma once

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// The graver, the longer.
[[nodiscard]] double toast_duration_s(Severity severity);

/// Takes new notices in, lets old ones go; only the latest few stay.
void update_toasts(const AppView& view, WindowState& state);

}  // namespace flytri::ui
