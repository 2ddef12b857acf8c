/// @file  States of a guided calibration for the window, without a sensor.
#pragma once

#include "ui/state/calibration_state.h"

namespace flytri::testing {

/// Half of the planes are done; next are the dots of a plane.
[[nodiscard]] ui::RunningCalibration waiting_calibration();
/// A shot of the white plane was refused.
[[nodiscard]] ui::RunningCalibration refused_shot();
/// All images are taken, but one plane does not fit the others.
[[nodiscard]] ui::RunningCalibration refused_set();
[[nodiscard]] ui::RunningCalibration finished_calibration();
/// A verification on a plane that found a changed sensor.
[[nodiscard]] ui::RunningCalibration broken_check();

}  // namespace flytri::testing
