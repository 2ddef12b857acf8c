/// @file  What the export dialog asks for, and whether the program has answered it.
#pragma once

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Of the report beside a model.
inline constexpr std::string_view kReportExtension = ".html";

/// Whether the form asks for all jaws of the case, and there is more than one.
[[nodiscard]] bool exports_all_jaws(const AppView& view, const ExportForm& form);

/// Whether there is something to report: a finished model.
[[nodiscard]] bool has_report(const AppView& view);

/// What the form and the settings ask for now. Formats that cannot hold what is shown are left out.
[[nodiscard]] ExportTarget export_target(const AppView& view, const ExportForm& form);

/// Whether a file of any kind is to be written.
[[nodiscard]] bool asks_for_files(const ExportTarget& target);

/// Whether the outcome in ExportState is of what is asked for now.
[[nodiscard]] bool has_outcome(const AppView& view, const ExportForm& form);

/// Whether files of what is asked for exist, and the user was told so: the next export replaces
/// them.
[[nodiscard]] bool is_replacing(const AppView& view, const ExportForm& form);

}  // namespace flytri::ui
