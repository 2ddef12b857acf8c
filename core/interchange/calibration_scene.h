/// @file  What files about calibrations say of volume, lines and target, in JSON.
///
/// For sources that read a file format only: it brings the JSON library with it.
#pragma once

#include <nlohmann/json.hpp>

#include "core/calibrating/calibration_set.h"
#include "core/interchange/json_place.h"

namespace flytri {

/// Adds measurement_volume_mm, lines and dots; planes are left to the caller.
void put_calibration_scene(nlohmann::ordered_json& json, const CalibrationSet& scene);

/// Reads what put_calibration_scene wrote; failures are noted at the place.
/// @return  a set without planes
[[nodiscard]] CalibrationSet read_calibration_scene(const JsonPlace& json);

}  // namespace flytri
