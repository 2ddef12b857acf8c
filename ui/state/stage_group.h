/// @file  The scans of one jaw, or of the bite, which share a tab of the window.
#pragma once

#include <vector>

#include "ui/state/app_view.h"

namespace flytri::ui {

/// The stages that the window offers now of the group that a stage belongs to, the ordinary one
/// first: those that hold something, and the shown one. The second bite is offered once the first
/// is scanned.
[[nodiscard]] std::vector<io::ScanStage> offered_with(io::ScanStage stage, const AppView& view);

/// The first stages of the groups that have a tab: those that the sensor is for, and those that
/// hold something.
[[nodiscard]] std::vector<io::ScanStage> offered_tabs(const AppView& view);

/// What the stage is called among those of its group: "Upper jaw", "Pre-op", "Other side".
[[nodiscard]] Text name_in_group(io::ScanStage stage);
/// As short as a tab needs: "Upper", "Pre-op", "Bite 2".
[[nodiscard]] Text tab_name(io::ScanStage stage);

/// Whether a stage can start as a copy of the one that is shown.
[[nodiscard]] bool can_copy_to(io::ScanStage stage, const AppView& view);

enum class StageProgress { kEmpty, kScanned, kFinished };
[[nodiscard]] StageProgress progress_of(io::ScanStage stage, const AppView& view);
/// Of all stages of the group together: finished if nothing that was scanned remains to be
/// finished.
[[nodiscard]] StageProgress progress_of_group(io::ScanStage stage, const AppView& view);

}  // namespace flytri::ui
