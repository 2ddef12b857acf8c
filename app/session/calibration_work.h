/// @file  The two jobs of a calibration run: to calibrate a sensor, and to check its calibration.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/guide/calibration_plan.h"
#include "core/calibration/record/calibration.h"
#include "hw/shots/shot_source.h"
#include "ui/state/calibration_state.h"
#include "ui/state/command.h"
#include "ui/text/texts.h"

namespace flytri::session {

/// Used by one thread at a time.
class CalibrationWork {
 public:
  using Tell = std::function<void(ui::JudgedShot)>;
  /// The live image in which the user sees whether the target is in place.
  struct Look {
    calibration::ShotKind kind = calibration::ShotKind::kVertical;
    double z_mm = 0.0;
  };

  virtual ~CalibrationWork() = default;
  CalibrationWork(const CalibrationWork&) = delete;
  CalibrationWork& operator=(const CalibrationWork&) = delete;

  /// All places at which the user puts the target, in order.
  [[nodiscard]] virtual std::vector<ui::CalibrationPlace> places() const = 0;
  /// Index of the next place. None: all are done.
  [[nodiscard]] virtual std::optional<std::size_t> wanted() const = 0;
  /// The live image for the next place.
  [[nodiscard]] virtual Look look() const = 0;

  /// Takes the images at the next place. If one of them is refused, the place stays the next one.
  /// @param tell  called with the verdict on each image
  /// @errors  As the devices and the disk; kCancelled.
  [[nodiscard]] virtual Result<void> take(const Tell& tell, const Progress& progress) = 0;
  /// Makes this place the next one again.
  /// @errors  As the disk.
  [[nodiscard]] virtual Result<void> reopen(std::size_t place) = 0;
  /// Computes the result, once all places are done.
  /// @errors  kInconsistent, kInsufficient: the images do not fit together; the message names those
  ///          that do not. As the disk; kCancelled.
  [[nodiscard]] virtual Result<ui::CalibrationOutcome> conclude(const Progress& progress) = 0;

 protected:
  CalibrationWork() = default;
};

/// Calibrates, and continues with what the folder contains, see GuidedSession.
/// @param begun  with the folder, and the note of the calibration
/// @param texts  for places, images and results
/// @errors  As GuidedSession::open.
[[nodiscard]] Result<std::unique_ptr<CalibrationWork>> calibrate_guided(
    const ui::BeginCalibration& begun, const calibration::CalibrationPlan& plan,
    std::shared_ptr<shots::ShotSource> source, const ui::Texts& texts = {});

/// Checks a calibration on a plane or on a sphere.
/// @param sphere_diameter_mm  > 0; none: on a plane
[[nodiscard]] std::unique_ptr<CalibrationWork> check_guided(
    std::shared_ptr<const calibration::Calibration> calibration,
    std::optional<double> sphere_diameter_mm, std::shared_ptr<shots::ShotSource> source,
    const ui::Texts& texts = {});

}  // namespace flytri::session
