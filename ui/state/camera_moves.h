/// @file  Moves the camera, automatically or on request: to the whole model, a standard view, a
/// hole, or a place to resume at.
#pragma once

#include "ui/scene/standard_views.h"
#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Shows the whole model, and keeps showing it while it grows.
/// @param model_box_mm  empty if there is no model: shows the measurement volume of the sensor
void show_all(const AppView& view, const Eigen::AlignedBox3d& model_box_mm, CameraState& state);

/// Resets the camera: move_automatically() then shows the whole model, from the side of the first
/// view.
void reset_camera(CameraState& state);

/// Shows a jaw from a side.
void show_from(StandardView side, const JawAxes& axes, JawKind jaw, CameraState& state);
/// Shows the whole jaw of the current stage from a side.
void show_from(StandardView side, const AppView& view, CameraState& state);

/// Selects and shows the next hole; the widest comes first. Without holes none is selected.
void show_next_hole(const AppView& view, WindowState& state);

/// Selects and shows one of the scan's holes.
void show_hole(const AppView& view, std::size_t index, WindowState& state);

/// Call once a frame: follows the growing model; after a loss shows the place to resume at.
void move_automatically(const AppView& view, const Eigen::AlignedBox3d& model_box_mm,
                        CameraState& state);

}  // namespace flytri::ui
