/// @file  The parts of the window, each drawn by a file of its own name.
#pragma once

#include <optional>

#include "ui/panels/panel.h"

namespace flytri::ui {

// The fixed parts.
void draw_top_bar(const PanelContext& context);
void draw_bottom_bar(const PanelContext& context);
void draw_side_panel(const PanelContext& context);
void draw_scene_panel(const PanelContext& context);

/// Lengths beside the measured distances, in the window of the scene.
void draw_distance_labels(const PanelContext& context);

// Overlays of the scene; each is drawn only when it has something to show.
void draw_status_banner(const PanelContext& context);
void draw_look_panel(const PanelContext& context);
/// The two parts of the look panel: colors with legend, and sides to look from.
[[nodiscard]] Rect colors_box(const PanelContext& context);
[[nodiscard]] Rect sides_box(const PanelContext& context);
void draw_findings_panel(const PanelContext& context);
/// None while there are no findings.
[[nodiscard]] std::optional<Rect> findings_box(const PanelContext& context);
void draw_tool_strip(const PanelContext& context);
void draw_finishing_card(const PanelContext& context);
/// At the lower right, while raw images are recorded, or the recording has failed.
void draw_recording_card(const PanelContext& context);
/// Its height with the gap above it; 0: it is not shown.
[[nodiscard]] float recording_card_height(const PanelContext& context);
void draw_toasts(const PanelContext& context);

/// After a loss, the side panel shows where to resume instead.
void draw_continuation(const PanelContext& context, const Rect& box);

/// The side panel of a finished bite: how the jaws meet, or what is missing for it.
void draw_occlusion(const PanelContext& context, const Rect& box);

/// The side panel while a finished model is measured.
void draw_review(const PanelContext& context, const Rect& box);

// Dialogs, while they are open.
void draw_help_dialog(const PanelContext& context);
void draw_export_dialog(const PanelContext& context);
void draw_case_dialog(const PanelContext& context);
void draw_question_dialog(const PanelContext& context);
void draw_stages_dialog(const PanelContext& context);
void draw_settings_dialog(const PanelContext& context);
void draw_device_panel(const PanelContext& context);
void draw_calibration_panel(const PanelContext& context);
void draw_setup_panel(const PanelContext& context);

}  // namespace flytri::ui
