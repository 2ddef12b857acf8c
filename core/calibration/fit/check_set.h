/// @file  Rejects calibration sets that cannot be fitted, before the fit starts.
#pragma once

#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// Checks a set without its images.
/// @param set   its planes are ignored
/// @param z_mm  depths of the planes
/// @errors  kInsufficient or kInconsistent, naming the entry.
[[nodiscard]] Result<void> check_numbers(const CalibrationSet& set,
                                         const std::vector<double>& z_mm);

/// @errors  kInsufficient or kInconsistent, naming the image or the entry.
[[nodiscard]] Result<void> check_set(const CalibrationSet& set);

}  // namespace flytri::calibration
