/// @file  When the calibration in use was made and checked, and what the sensor had before it.
#pragma once

#include "core/calibration/record/calibration_history.h"
#include "ui/panels/panel.h"

namespace flytri::ui {

/// As many events as the box takes, the latest first.
void draw_calibration_history(const PanelContext& context, Rect box,
                              const calibration::CalibrationHistory& history);

}  // namespace flytri::ui
