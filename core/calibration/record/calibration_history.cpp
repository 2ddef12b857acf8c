#include "core/calibration/record/calibration_history.h"

#include <algorithm>
#include <utility>

#include "core/base/iso_time.h"

namespace flytri::calibration {

CalibrationHistory continued(const CalibrationHistory& replaced, CalibrationHistory next,
                             std::time_t now, const std::string& kept_in) {
  next.past = replaced.past;
  next.past.push_back({replaced.made_at, replaced.note, replaced.checks, iso_time(now), kept_in});
  return next;
}

std::optional<int> days_since_valid(const CalibrationHistory& history, std::time_t now) {
  constexpr std::time_t kDay_s = 86'400;
  std::optional<std::time_t> valid = parse_iso_time(history.made_at);
  for (const CalibrationCheck& check : history.checks) {
    const auto checked = parse_iso_time(check.at);
    if (checked && check.has_passed) valid = std::max(valid.value_or(*checked), *checked);
  }
  if (!valid) return std::nullopt;
  return static_cast<int>(std::max<std::time_t>(0, now - *valid) / kDay_s);
}

}  // namespace flytri::calibration
