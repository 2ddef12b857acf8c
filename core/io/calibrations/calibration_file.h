/// @file  Reads and writes calibration.json.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/calibration/record/calibration.h"

namespace flytri::io {

/// @errors  As read_file and parse_calibration.
[[nodiscard]] Result<calibration::Calibration> read_calibration(const std::filesystem::path& path);

/// @errors  As write_file.
[[nodiscard]] Result<void> write_calibration(const std::filesystem::path& path,
                                             const calibration::Calibration& calibration);

}  // namespace flytri::io
