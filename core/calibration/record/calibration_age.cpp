#include "core/calibration/record/calibration_age.h"

#include <algorithm>

#include "core/base/iso_time.h"

namespace flytri::calibration {

std::optional<int> days_since_valid(const CalibrationHistory& history, std::time_t now) {
  constexpr std::time_t kDay_s = 24 * 60 * 60;
  std::optional<std::time_t> valid = parse_iso_time(history.made_at);
  const auto checked = parse_iso_time(history.checked_at);
  if (checked && history.has_passed) valid = std::max(valid.value_or(*checked), *checked);
  if (!valid) return std::nullopt;
  return static_cast<int>(std::max<std::time_t>(0, now - *valid) / kDay_s);
}

}  // namespace flytri::calibration
