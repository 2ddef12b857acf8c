/// @file  When a calibration was made and checked, and which ones the sensor had before it.
#pragma once

#include <ctime>
#include <optional>
#include <string>
#include <vector>

namespace flytri::calibration {

/// A check of a calibration on an object. Times are ISO 8601, UTC; empty: not known.
struct CalibrationCheck {
  std::string at;
  bool has_passed = false;
  std::string note;  ///< in the words of the user, such as the temperature; empty: none
};

/// A calibration that the sensor had before.
struct PastCalibration {
  std::string made_at;
  std::string note;
  std::vector<CalibrationCheck> checks;
  std::string replaced_at;
  std::string kept_in;  ///< name of its file, beside that of the calibration; empty: not kept
};

struct CalibrationHistory {
  std::string made_at;
  std::string note;
  std::vector<CalibrationCheck> checks;  ///< by time
  std::vector<PastCalibration> past;     ///< by time

  /// Null: it was never checked.
  [[nodiscard]] const CalibrationCheck* last_check() const {
    return checks.empty() ? nullptr : &checks.back();
  }
};

/// Notes that a calibration was replaced by `next` of the same sensor.
/// @param kept_in  see PastCalibration
/// @return  the history of `next`, with all that the replaced one had
[[nodiscard]] CalibrationHistory continued(const CalibrationHistory& replaced,
                                           CalibrationHistory next, std::time_t now,
                                           const std::string& kept_in);

/// Check the sensor about so often: heat and small knocks move lenses and slides.
inline constexpr int kCheckEvery_days = 30;

/// Whole days since the calibration was made, or passed a check, whichever is later. None: not
/// known.
[[nodiscard]] std::optional<int> days_since_valid(const CalibrationHistory& history,
                                                  std::time_t now);

}  // namespace flytri::calibration
