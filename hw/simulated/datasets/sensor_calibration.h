/// @file  Calibrates a virtual sensor like a real one, from images of the targets.
#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Simulates a calibration set and fits the calibration to it.
/// @errors  As take_calibration_set and calibrate.
[[nodiscard]] Result<calibration::Calibration> calibrate_virtual_sensor(const SensorModel& sensor,
                                                                        const Workers& workers,
                                                                        const Progress& progress);

/// Where cached_sensor_calibration() keeps the calibration of a sensor model.
[[nodiscard]] std::filesystem::path sensor_calibration_file(const SensorModel& sensor,
                                                            const std::filesystem::path& folder);

/// Where calibrations of virtual sensors may be.
struct CalibrationFolders {
  std::filesystem::path cache;
  std::filesystem::path shipped;  ///< what comes with the program, read only; empty: nothing
};

/// Reads the calibration of exactly this sensor model from the cache. If that fails, takes the
/// shipped one, or else computes it; then saves it in the cache, if possible.
/// @errors  As calibrate_virtual_sensor.
[[nodiscard]] Result<calibration::Calibration> cached_sensor_calibration(
    const SensorModel& sensor, const CalibrationFolders& folders, const Workers& workers,
    const Progress& progress);

}  // namespace flytri::simulated
