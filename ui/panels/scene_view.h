/// @file  Translates the view and the window's state to the content of the scene.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// Moves the camera as the scan requires, then updates the picture of the scene.
void draw_scene(const PanelContext& context);

}  // namespace flytri::ui
