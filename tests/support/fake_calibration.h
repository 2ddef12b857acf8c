/// @file  Fake calibrations, as the window shows them.
#pragma once

#include "ui/state/calibration_state.h"

namespace flytri::testing {

/// Half the planes are done; the dot target is next.
[[nodiscard]] ui::RunningCalibration waiting_calibration();
/// An image of the white plane was refused.
[[nodiscard]] ui::RunningCalibration refused_shot();
/// All images are there, but one plane does not fit the others.
[[nodiscard]] ui::RunningCalibration refused_set();
[[nodiscard]] ui::RunningCalibration finished_calibration();
/// A check on a plane which shows that the sensor has changed.
[[nodiscard]] ui::RunningCalibration broken_check();

}  // namespace flytri::testing
