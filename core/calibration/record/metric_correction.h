/// @file  Corrects the millimeters of a calibration whose target or stage was not as told.
///
/// A target printed too large scales x and y. A stage with a wrong pitch scales z. A stage that
/// does not move at right angles to the target shears: planes at other depths seem shifted
/// sideways.
#pragma once

#include "core/calibration/record/calibration.h"

namespace flytri::calibration {

/// true = matrix() * measured, in the sensor frame.
struct MetricCorrection {
  double lateral = 1.0;                             ///< > 0, scale of x and y
  double depth = 1.0;                               ///< > 0, scale of z
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();  ///< x and y per z

  [[nodiscard]] Eigen::Matrix3d matrix() const;
};

/// Corrects the polynomials, which keep their degree, exactly. The measurement volume and the areas
/// of the lines stay as they are.
[[nodiscard]] Calibration corrected(const Calibration& calibration,
                                    const MetricCorrection& correction);

}  // namespace flytri::calibration
