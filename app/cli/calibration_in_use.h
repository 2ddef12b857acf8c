/// @file  flytri calibrate --use and --history: takes a calibration into use, and tells its
/// history.
#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace flytri::cli {

/// @param rig  rig.json
/// @errors  As session::adopt_calibration.
[[nodiscard]] Result<void> use_calibration(const std::filesystem::path& calibration,
                                           const std::filesystem::path& rig);

/// @errors  As io::read_calibration.
[[nodiscard]] Result<void> print_calibration_history(const std::filesystem::path& calibration);

}  // namespace flytri::cli
