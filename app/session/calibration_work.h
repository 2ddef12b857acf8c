/// @file  What is done with a sensor that is handed to the calibration: calibrating it, or checking
/// its calibration.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/guide/calibration_plan.h"
#include "core/calibration/record/calibration.h"
#include "hw/shots/shot_source.h"
#include "ui/state/calibration_state.h"

namespace flytri::session {

/// Used by one thread at a time.
class CalibrationWork {
 public:
  using Tell = std::function<void(ui::JudgedShot)>;
  /// The image in which the user sees whether the target is in place.
  struct Look {
    calibration::ShotKind kind = calibration::ShotKind::kVertical;
    double z_mm = 0.0;
  };

  virtual ~CalibrationWork() = default;
  CalibrationWork(const CalibrationWork&) = delete;
  CalibrationWork& operator=(const CalibrationWork&) = delete;

  /// All that the user is to do, in order.
  [[nodiscard]] virtual std::vector<ui::CalibrationPlace> places() const = 0;
  /// Index of the next of them; none: all are done.
  [[nodiscard]] virtual std::optional<std::size_t> wanted() const = 0;
  /// Of the place that is wanted.
  [[nodiscard]] virtual Look look() const = 0;

  /// Takes the images of the place that is wanted. It stays wanted if one of them is refused.
  /// @param tell  hears of each image
  /// @errors  Of devices and disk; kCancelled.
  [[nodiscard]] virtual Result<void> take(const Tell& tell, const Progress& progress) = 0;
  /// @errors  Of the disk.
  [[nodiscard]] virtual Result<void> reopen(std::size_t place) = 0;
  /// What comes of them once all are done.
  /// @errors  kInconsistent, kInsufficient: the images do not fit together, and which do not; of
  ///          the disk; kCancelled.
  [[nodiscard]] virtual Result<ui::CalibrationOutcome> conclude(const Progress& progress) = 0;

 protected:
  CalibrationWork() = default;
};

/// Calibrates: goes on with what the folder holds, see GuidedSession.
/// @errors  As GuidedSession::open.
[[nodiscard]] Result<std::unique_ptr<CalibrationWork>> calibrate_guided(
    const std::filesystem::path& folder, const calibration::CalibrationPlan& plan,
    std::shared_ptr<shots::ShotSource> source);

/// Checks on a plane, or on a sphere of that diameter.
/// @param sphere_diameter_mm  > 0, or none for a plane
[[nodiscard]] std::unique_ptr<CalibrationWork> check_guided(
    std::shared_ptr<const calibration::Calibration> calibration,
    std::optional<double> sphere_diameter_mm, std::shared_ptr<shots::ShotSource> source);

}  // namespace flytri::session
