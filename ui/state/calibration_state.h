/// @file  A calibration at the chair, or a check of one, as its panel shows it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/calibration/fit/plane_residuals.h"
#include "core/calibration/verify/verification_report.h"
#include "core/scan/scan_snapshot.h"

namespace flytri::ui {

enum class CalibrationTask { kCalibrate, kCheckOnPlane, kCheckOnSphere };

/// Where a task stands.
///
///     kOpening ──▶ kTarget ──take──▶ kTaking ──all there──▶ kComputing ──▶ kDone
///                    ▲ ▲                │                        │
///                    │ └────────────────┘                     refused
///                    └──────retake────── kRefused ◀──────────────┘
///
/// kFailed, for devices and disks, is reached from every step.
enum class CalibrationStep { kOpening, kTarget, kTaking, kComputing, kRefused, kDone, kFailed };
/// For tests: "opening".
[[nodiscard]] std::string_view to_string(CalibrationStep step);

/// One handling of the user's: something is put somewhere, and rests there for its images.
struct CalibrationPlace {
  std::string target;  ///< "white plane"
  std::string where;   ///< "at z = +7.50 mm"
  std::string label;   ///< short, of its column: "+7.5"
  std::size_t column = 0, row = 0;
  bool is_done = false;
};

/// What was said of one image of the latest place.
struct JudgedShot {
  std::string name;
  bool is_good = true;
  std::string finding;  ///< with its numbers
  std::string remedy;   ///< of one that is refused
};

/// What a task came to.
struct CalibrationOutcome {
  bool is_good = false;
  std::string verdict;                             ///< one line
  std::vector<std::string> meanings;               ///< what it means, a sentence each
  std::vector<calibration::PlaneResidual> planes;  ///< of a calibration
  double plane_limit_mm = 0.0;                     ///< beyond it the set would have been refused
  std::vector<calibration::VerificationFigure> figures;  ///< of a check
};

struct RunningCalibration {
  CalibrationTask task = CalibrationTask::kCalibrate;
  CalibrationStep step = CalibrationStep::kOpening;
  std::string folder;  ///< of a calibration
  std::vector<CalibrationPlace> places;
  std::optional<std::size_t> wanted;  ///< index of the place that comes next
  std::vector<JudgedShot> shots;
  std::shared_ptr<const scan::LiveFrame> image;  ///< what the camera sees now
  double computed_share = 0.0;                   ///< 0..1
  std::string message;                           ///< why it was refused or failed
  CalibrationOutcome outcome;
};

/// The place that is taken again by who wants one back: the last that is done.
[[nodiscard]] std::optional<std::size_t> previous_place(const RunningCalibration& running);

/// What can be calibrated and checked, and what is being done of it.
struct CalibrationState {
  std::string folder;            ///< proposed for a new calibration
  bool has_calibration = false;  ///< there is one to be checked
  bool is_simulated = false;     ///< the virtual sensor, which sees a plane and nothing else
  std::string why_not_used;      ///< why a new one cannot be taken into use; empty: it can
  std::optional<RunningCalibration> running;
};

}  // namespace flytri::ui
