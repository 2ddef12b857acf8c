/// @file  What of the view and the window's state the scene shows, and how.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// Moves the camera by what happens in the scan, then brings the renderer's picture up to date.
void draw_scene(const PanelContext& context);

/// End of the color scale of uncertainty: about the noise of a single point, which goes with the
/// size of the sensor's volume.
[[nodiscard]] double max_sigma_mm(const AppView& view);

}  // namespace flytri::ui
