/// @file  The parts of the calibration panel: places, judged shots, and what came out.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// A cell for each place; one that is done is wanted again by a click.
void draw_calibration_places(const PanelContext& context, Rect box,
                             const RunningCalibration& running);
[[nodiscard]] float calibration_places_height(const PanelContext& context,
                                              const RunningCalibration& running);

void draw_judged_shots(const PanelContext& context, Rect box, const RunningCalibration& running);

/// Planes of a calibration as a chart, deviations of a check as a table.
void draw_outcome(const PanelContext& context, Rect box, const CalibrationOutcome& outcome);

}  // namespace flytri::ui
