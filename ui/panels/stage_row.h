/// @file  The scans of one jaw, or of the bite, at the top of the side panel.
#pragma once

#include "ui/panels/panel.h"
#include "ui/state/stage_group.h"

namespace flytri::ui {

/// Half a disk for what is scanned, a check mark for what is finished; null: nothing is.
[[nodiscard]] const char* mark_of(StageProgress progress);

/// A button for each scan that the window offers, and for a jaw one to begin another scan. Not
/// while one is scanned.
/// @param rest  the panel; afterwards what is free of it
void draw_stage_row(const PanelContext& context, Rect& rest);

}  // namespace flytri::ui
