/// @file  What files about calibrations say of volume, lines and target, in JSON.
///
/// For sources that read a file format only: it brings the JSON library with it.
#pragma once

#include <nlohmann/json.hpp>

#include "core/calibration/record/calibration_set.h"
#include "core/io/files/json_place.h"

namespace flytri::io {

/// Adds measurement_volume_mm, lines and dots; planes are left to the caller.
void put_calibration_scene(nlohmann::ordered_json& json, const calibration::CalibrationSet& scene);

/// Reads what put_calibration_scene wrote; failures are noted at the place.
/// @return  a set without planes
[[nodiscard]] calibration::CalibrationSet read_calibration_scene(const JsonPlace& json);

}  // namespace flytri::io
