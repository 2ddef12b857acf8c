/// @file  Fits X, Y of the measurement camera and U, V of the texture camera to images of the dots.
#pragma once

#include "core/base/workers.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// The four cubic functions of a calibration.
struct LateralCalibration {
  TrivariateCubic x_mm, y_mm;
  TrivariateCubic texture_u_px, texture_v_px;
};

/// Without a texture camera, U and V stay empty.
/// @source  Arold et al., "xy-Calibration" and "Inverse Lateral Calibration".
/// @errors  kInsufficient or kInconsistent, naming the image.
[[nodiscard]] Result<LateralCalibration> fit_lateral(const CalibrationSet& set,
                                                     const Workers& workers);

}  // namespace flytri::calibration
