/// @file  Which notices show, and for how long.
#pragma once

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Longer for graver messages.
[[nodiscard]] double toast_duration_s(Severity severity);

/// Adds new notices and removes old ones; only the latest few stay.
void update_toasts(const AppView& view, WindowState& state);

}  // namespace flytri::ui
