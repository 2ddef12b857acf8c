/// @file  The lower half of the device panel: how each device runs, and its problems.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// Both need AppView::devices.
void draw_device_cards(const PanelContext& context, Rect box);
void draw_device_check(const PanelContext& context, Rect box);

}  // namespace flytri::ui
