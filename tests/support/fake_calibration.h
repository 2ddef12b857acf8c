/// @file  Calibrations at the chair as the window shows them, without a sensor.
#pragma once

#include "ui/state/calibration_state.h"

namespace flytri::testing {

/// Half the planes are done, the dots of the next are wanted.
[[nodiscard]] ui::RunningCalibration waiting_calibration();
/// A shot of the white plane was refused.
[[nodiscard]] ui::RunningCalibration refused_shot();
/// All images are there, but one plane does not fit the others.
[[nodiscard]] ui::RunningCalibration refused_set();
[[nodiscard]] ui::RunningCalibration finished_calibration();
/// A check on a plane that found the sensor changed.
[[nodiscard]] ui::RunningCalibration broken_check();

}  // namespace flytri::testing
