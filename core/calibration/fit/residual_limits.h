/// @file  Refuses a calibration whose fits leave too much.
#pragma once

#include "core/calibration/fit/calibrate.h"

namespace flytri::calibration {

/// @errors  kInconsistent, naming the fit.
[[nodiscard]] Result<void> check_residuals(const Calibration& calibration,
                                           const CalibrateOptions& options);

}  // namespace flytri::calibration
