/// @file  Refuses calibration sets that cannot be fitted before any time is spent on them.
#pragma once

#include "core/calibrating/calibration_set.h"

namespace flytri {

/// @errors  kInsufficient or kInconsistent, naming the image or the entry.
[[nodiscard]] Result<void> check_set(const CalibrationSet& set);

}  // namespace flytri
