/// @file  What the pointer does in the scene: turns the camera, paints, measures, moves the hand.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// Follows the item drawn last, which must cover the picture.
void handle_scene_input(const PanelContext& context);

}  // namespace flytri::ui
