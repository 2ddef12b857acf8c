/// @file  flytri calibrate --check: whether a calibration still holds, told from a plane or sphere.
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/command.h"

namespace flytri::cli {

struct CalibrateCheckArguments {
  std::filesystem::path calibration = "calibration.json";  ///< of the sensor, as it was
  std::filesystem::path recording;  ///< of the object in slow motion; empty: taken on the spot
  std::filesystem::path rig = "rig.json";
  bool simulated = false;
  std::string sensor = "intraoral";  ///< that is simulated
  double sphere_mm = 0.0;            ///< diameter; 0: a plane
};

/// @errors  kInconsistent: the calibration no longer holds; kInsufficient: no verdict; as the
///          devices and files.
[[nodiscard]] Result<void> calibrate_check(const CalibrateCheckArguments& arguments,
                                           const Progress& progress);

}  // namespace flytri::cli
