/// @file  States of a guided calibration for the window, without a sensor.
#pragma once

#include "ui/state/calibration_state.h"
#include "ui/text/texts.h"

namespace flytri::testing {

/// Half of the planes are done; next are the dots of a plane.
[[nodiscard]] ui::RunningCalibration waiting_calibration(const ui::Texts& texts);
/// A shot of the white plane was refused.
[[nodiscard]] ui::RunningCalibration refused_shot(const ui::Texts& texts);
/// All images are taken, but one plane does not fit the others.
[[nodiscard]] ui::RunningCalibration refused_set(const ui::Texts& texts);
[[nodiscard]] ui::RunningCalibration finished_calibration(const ui::Texts& texts);
/// A verification on a plane that found a changed sensor.
[[nodiscard]] ui::RunningCalibration broken_check(const ui::Texts& texts);

}  // namespace flytri::testing
