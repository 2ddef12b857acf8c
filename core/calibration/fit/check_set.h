/// @file  Refuses calibration sets that cannot be fitted before any time is spent on them.
#pragma once

#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// What can be said of a set before it has images.
/// @param set   its planes are not looked at
/// @param z_mm  depths of the planes
/// @errors  kInsufficient or kInconsistent, naming the entry.
[[nodiscard]] Result<void> check_numbers(const CalibrationSet& set,
                                         const std::vector<double>& z_mm);

/// @errors  kInsufficient or kInconsistent, naming the image or the entry.
[[nodiscard]] Result<void> check_set(const CalibrationSet& set);

}  // namespace flytri::calibration
