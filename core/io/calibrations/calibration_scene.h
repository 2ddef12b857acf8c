/// @file  Measurement volume, line counts and dot target in the JSON files of calibrations.
///
/// Include it only in sources that read a file format: it includes the JSON library.
#pragma once

#include <nlohmann/json.hpp>

#include "core/calibration/record/calibration_set.h"
#include "core/io/files/json_place.h"

namespace flytri::io {

/// Adds measurement_volume_mm, lines and dots. The caller adds the images.
void put_calibration_scene(nlohmann::ordered_json& json,
                           const calibration::CalibrationScene& scene);

/// Reads what put_calibration_scene wrote; failures are recorded at the place.
[[nodiscard]] calibration::CalibrationScene read_calibration_scene(const JsonPlace& json);

}  // namespace flytri::io
