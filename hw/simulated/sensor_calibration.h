/// @file  Calibrates the virtual sensor as its user would: from images of the target.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/calibration.h"
#include "hw/simulated/sensor_model.h"

namespace flytri {

/// Takes the images of a calibration set and fits the calibration to them.
/// @errors  As take_calibration_set and calibrate.
[[nodiscard]] Result<Calibration> calibrate_virtual_sensor(const SensorModel& sensor,
                                                           const Workers& workers,
                                                           const Progress& progress);

}  // namespace flytri
