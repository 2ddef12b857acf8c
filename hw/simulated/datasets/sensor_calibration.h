/// @file  Calibrates the virtual sensor as its user would: from images of the target.
#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Takes the images of a calibration set and fits the calibration to them.
/// @errors  As take_calibration_set and calibrate.
[[nodiscard]] Result<calibration::Calibration> calibrate_virtual_sensor(const SensorModel& sensor,
                                                                        const Workers& workers,
                                                                        const Progress& progress);

/// The calibration that `folder` keeps of exactly this sensor model. Where it keeps none, or a
/// damaged one, it is made and, if the folder can be written, kept.
/// @errors  As calibrate_virtual_sensor.
[[nodiscard]] Result<calibration::Calibration> kept_sensor_calibration(
    const SensorModel& sensor, const std::filesystem::path& folder, const Workers& workers,
    const Progress& progress);

}  // namespace flytri::simulated
