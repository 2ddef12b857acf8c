/// @file  What the export dialog asks for, and whether the program has answered it.
#pragma once

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Whether the form asks for all jaws of the case, and there is more than one.
[[nodiscard]] bool exports_all_jaws(const AppView& view, const ExportForm& form);

/// What the form and the settings ask for now. Formats that cannot hold what is shown are left out.
[[nodiscard]] ExportTarget export_target(const AppView& view, const ExportForm& form);

/// Whether the outcome in ExportState is of what is asked for now.
[[nodiscard]] bool has_outcome(const AppView& view, const ExportForm& form);

/// Whether files of what is asked for exist, and the user was told so: the next export replaces
/// them.
[[nodiscard]] bool is_replacing(const AppView& view, const ExportForm& form);

}  // namespace flytri::ui
