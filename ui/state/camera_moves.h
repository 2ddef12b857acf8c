/// @file  Where the camera goes by itself or on request: to all of the model, a named view, a hole,
/// a place to re-enter.
#pragma once

#include "ui/scene/standard_views.h"
#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Flies to all of the model and keeps it in the picture while it grows.
/// @param model_box_mm  empty where there is no model: the camera looks at the sensor's volume
void show_all(const AppView& view, const Eigen::AlignedBox3d& model_box_mm, CameraState& state);

/// Forgets where the camera looked: move_by_itself() flies to all of what there is, as the first
/// view saw it.
void look_anew(CameraState& state);

/// Flies to a view of the whole jaw.
void show_from(StandardView side, const scan::ScanSnapshot& scan, CameraState& state);

/// Flies to the hole after the selected one, the widest first; none is selected where there is
/// none.
void show_next_hole(const AppView& view, WindowState& state);

/// Flies to one of the scan's holes and selects it.
void show_hole(const AppView& view, std::size_t index, WindowState& state);

/// Once a frame: follows the growing model, flies to the chosen place of re-entry and back.
void move_by_itself(const AppView& view, const Eigen::AlignedBox3d& model_box_mm,
                    CameraState& state);

}  // namespace flytri::ui
