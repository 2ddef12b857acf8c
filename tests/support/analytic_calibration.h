/// @file  The calibration of the analytic sensor, made once for the tests that only use it.
#pragma once

#include "core/calibrating/calibrate.h"
#include "tests/support/analytic_sensor.h"

namespace flytri::testing {

inline const Calibration& analytic_calibration() {
  static const Calibration kCalibration =
      calibrate(draw_set(AnalyticSensor{}, 9), {}, Workers(2), {}).value();
  return kCalibration;
}

}  // namespace flytri::testing
