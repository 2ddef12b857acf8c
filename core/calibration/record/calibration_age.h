/// @file  How long ago a calibration was found to be valid.
#pragma once

#include <ctime>
#include <optional>

#include "core/calibration/record/calibration.h"

namespace flytri::calibration {

/// Check the sensor about so often: heat and small knocks move lenses and slides.
inline constexpr int kCheckEvery_days = 30;

/// Whole days since the calibration was made, or passed a check, whichever is later. None: not
/// known.
[[nodiscard]] std::optional<int> days_since_valid(const CalibrationHistory& history,
                                                  std::time_t now);

}  // namespace flytri::calibration
