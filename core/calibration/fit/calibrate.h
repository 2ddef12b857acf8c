/// @file  Fits the calibration of a sensor to the images of a calibration set.
#pragma once

#include "core/base/progress.h"
#include "core/base/workers.h"
#include "core/calibration/fit/fit_lines.h"
#include "core/calibration/record/calibration_set.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

/// How a calibration is fitted, and when it is rejected.
struct CalibrateOptions {
  localization::LocalizeOptions localize;
  LineFitOptions lines;
  /// > 0. Largest RMS residual of Z, X and Y as a share of the volume's size along that axis. A
  /// working sensor has a tenth of this, wrong numbers cause far more.
  double max_residual_share = 0.005;
  /// > 0. Largest RMS residual of U and V as a share of the texture image's width.
  double max_texture_residual_share = 0.002;

  [[nodiscard]] Result<void> validate() const;
};

/// Fits a calibration.
/// @source  Arold et al., "Calibration".
/// @errors  kInsufficient or kInconsistent if the set cannot be fitted; the message names the image
///          or the line and the reason. kCancelled.
[[nodiscard]] Result<Calibration> calibrate(const CalibrationSet& set,
                                            const CalibrateOptions& options, const Workers& workers,
                                            const Progress& progress);

}  // namespace flytri::calibration
