/// @file  Finds the calibration of a recording.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/calibration/record/calibration.h"
#include "core/io/recordings/recording.h"

namespace flytri::io {

struct UsedCalibration {
  calibration::Calibration calibration;
  std::string warning;  ///< for the user; empty: none
};

/// Reads the calibration that the user chose, or else the one that the recording names, relative to
/// its folder. The recording may name the fingerprint of the calibration that it was made with: a
/// chosen calibration with another one is a warning.
/// @param chosen  path of a file; empty: none
/// @errors  kBadOption: none is chosen and none is named; kInconsistent: the named file has another
///          fingerprint; as read_calibration.
[[nodiscard]] Result<UsedCalibration> calibration_of(const Recording& recording,
                                                     const std::filesystem::path& chosen);

}  // namespace flytri::io
