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

/// A dot whose place is known.
struct PlacedDot {
  Vec3 p_sensor;  ///< mm
  Pixel center;   ///< in the image
};

/// @param dots          in images of the measurement camera
/// @param texture_dots  in those of the texture camera; empty: there is none, and U and V stay
/// empty
/// @errors  kInsufficient.
[[nodiscard]] Result<LateralCalibration> fit_lateral(const std::vector<PlacedDot>& dots,
                                                     const std::vector<PlacedDot>& texture_dots);

/// Without a texture camera, U and V stay empty.
/// @source  Arold et al., "xy-Calibration" and "Inverse Lateral Calibration".
/// @errors  kInsufficient or kInconsistent, naming the image.
[[nodiscard]] Result<LateralCalibration> fit_lateral(const CalibrationSet& set,
                                                     const Workers& workers);

}  // namespace flytri::calibration
