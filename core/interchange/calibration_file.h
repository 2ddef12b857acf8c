/// @file  calibration.json: the calibration record in a file.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/calibration/calibration.h"

namespace flytri {

/// @errors  As read_file and parse_calibration.
[[nodiscard]] Result<Calibration> read_calibration(const std::filesystem::path& path);

/// @errors  As write_file.
[[nodiscard]] Result<void> write_calibration(const std::filesystem::path& path,
                                             const Calibration& calibration);

}  // namespace flytri
