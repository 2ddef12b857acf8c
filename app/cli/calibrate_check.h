/// @file  flytri calibrate --check: checks a calibration on an object, or against another one.
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/command.h"

namespace flytri::cli {

struct CalibrateCheckArguments {
  std::filesystem::path calibration = "calibration.json";  ///< to check
  std::filesystem::path recording;  ///< of the slowly moving object; empty: take images
  std::filesystem::path rig = "rig.json";
  bool simulated = false;
  std::string sensor = "intraoral";  ///< with `simulated`: which sensor
  double sphere_mm = 0.0;            ///< diameter; 0: a plane
  std::filesystem::path against;     ///< another calibration; empty: check on an object
  std::filesystem::path corrected;   ///< calibration to write; empty: none. Needs `against`
  std::string note;                  ///< of the check
  bool force = false;                ///< `corrected` may replace a file
};

/// @errors  kInconsistent: the calibration is no longer valid; kInsufficient: not clear; as
///          open_shots and read_calibration.
[[nodiscard]] Result<void> calibrate_check(const CalibrateCheckArguments& arguments,
                                           const Progress& progress);

}  // namespace flytri::cli
