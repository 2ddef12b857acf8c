/// @file  The calibration of the analytic sensor, computed once and shared by tests.
#pragma once

#include "core/calibration/fit/calibrate.h"
#include "tests/support/analytic_sensor.h"

namespace flytri::testing {

inline const calibration::Calibration& analytic_calibration() {
  static const calibration::Calibration kCalibration =
      calibration::calibrate(draw_set(AnalyticSensor{}, 9), {}, Workers(2), {}).value();
  return kCalibration;
}

}  // namespace flytri::testing
