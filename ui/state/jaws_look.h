/// @file  Whether both jaws are shown, closed or opened.
#pragma once

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Whether the finished stages are enough to bring the jaws together: both jaws and a bite.
[[nodiscard]] bool can_meet(const ByStage<bool>& are_finished);

/// A finished bite is shown, or both jaws in its place.
[[nodiscard]] bool shows_finished_bite(const AppView& view);

/// The jaws that are shown in place of the bite scan; null: the scan is shown.
[[nodiscard]] const JawPair* shown_jaws(const AppView& view, const WindowState& state);

/// What the colors of the shown surface mean. Both jaws have no coverage and no uncertainty.
[[nodiscard]] ColorMode shown_colors(const AppView& view, const WindowState& state);

/// Motion of the lower jaw from the closed to the opened place, frame of the upper jaw. Of an arch
/// it turns about an axis where the joints are on average; of a part of one it goes straight away.
/// @param share  0 closed..1 wide open
[[nodiscard]] Isometry opening(const JawAxes& upper_axes, double share);

}  // namespace flytri::ui
