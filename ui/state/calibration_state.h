/// @file  A calibration at the chair, or a check of one, as its panel shows it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/calibration/fit/plane_residuals.h"
#include "core/calibration/record/calibration.h"
#include "core/calibration/verify/verification_report.h"
#include "core/scan/scan_snapshot.h"

namespace flytri::ui {

enum class CalibrationTask { kCalibrate, kCheckOnPlane, kCheckOnSphere };

/// The current step of a task.
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

/// One position at which the user holds a target still while images are taken.
struct CalibrationPlace {
  std::string target;  ///< "white plane"
  std::string where;   ///< "at z = +7.50 mm"
  std::string label;   ///< short, of its column: "+7.5"
  std::size_t column = 0, row = 0;
  bool is_done = false;
};

/// Whether one image of the latest place is usable.
struct JudgedShot {
  std::string name;
  bool is_good = true;
  std::string finding;  ///< with its numbers
  std::string remedy;   ///< of a refused image
};

/// The result of a task.
struct CalibrationOutcome {
  bool is_good = false;
  std::optional<bool> has_passed;                        ///< a check; none: no verdict, or no check
  std::string verdict;                                   ///< one line
  std::vector<std::string> meanings;                     ///< explanations, one sentence each
  std::vector<calibration::PlaneResidual> planes;        ///< of a calibration
  double plane_limit_mm = 0.0;                           ///< a set with a larger error is refused
  std::vector<calibration::VerificationFigure> figures;  ///< of a check
};

struct RunningCalibration {
  CalibrationTask task = CalibrationTask::kCalibrate;
  CalibrationStep step = CalibrationStep::kOpening;
  std::string folder;  ///< of a calibration
  std::vector<CalibrationPlace> places;
  std::optional<std::size_t> wanted;  ///< index of the next place
  std::vector<JudgedShot> shots;
  std::shared_ptr<const scan::LiveFrame> image;  ///< the live image
  double computed_share = 0.0;                   ///< 0..1
  std::string message;                           ///< why it was refused or failed
  CalibrationOutcome outcome;
};

/// The last finished place before the current one; its images can be taken again.
[[nodiscard]] std::optional<std::size_t> previous_place(const RunningCalibration& running);

/// Which calibrations and checks are possible, and the running one.
struct CalibrationState {
  std::string folder;                                           ///< proposed for a new calibration
  std::shared_ptr<const calibration::Calibration> calibration;  ///< in use; null: there is none
  bool is_simulated = false;  ///< the simulated sensor: it can be checked on a plane only
  std::string why_not_used;   ///< why a new calibration cannot be used; empty: it can
  std::optional<RunningCalibration> running;
};

}  // namespace flytri::ui
