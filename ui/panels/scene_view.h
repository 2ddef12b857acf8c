/// @file  Translates the view and the window's state to the content of the scene.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// Moves the camera as the scan requires, then updates the picture of the scene.
void draw_scene(const PanelContext& context);

/// End of the color scale of uncertainty: about the noise of a single point, which is proportional
/// to the size of the measurement volume.
[[nodiscard]] double max_sigma_mm(const AppView& view);

}  // namespace flytri::ui
