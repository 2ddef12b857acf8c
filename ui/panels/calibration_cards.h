/// @file  The parts of the calibration panel: places, judged images, and the result.
#pragma once

#include "ui/panels/panel.h"

namespace flytri::ui {

/// A cell for each place; a click on a finished one takes its images again.
void draw_calibration_places(const PanelContext& context, Rect box,
                             const RunningCalibration& running);
[[nodiscard]] float calibration_places_height(const PanelContext& context,
                                              const RunningCalibration& running);

void draw_judged_shots(const PanelContext& context, Rect box, const RunningCalibration& running);

/// Planes of a calibration as a chart, deviations of a check as a table.
void draw_outcome(const PanelContext& context, Rect box, const CalibrationOutcome& outcome);

}  // namespace flytri::ui
