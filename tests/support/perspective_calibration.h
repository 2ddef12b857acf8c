/// @file  Calibration of a texture camera with perspective, for tests.
#pragma once

#include "tests/support/orthographic_calibration.h"

namespace flytri::testing {

/// The camera stands at z = -distance_mm and looks along z: U = middle + px_per_mm x / (1 + z /
/// distance_mm), to second order in z.
inline calibration::Calibration perspective_calibration(const Vec3& volume_mm, ImageSize size,
                                                        double px_per_mm, double distance_mm) {
  calibration::Calibration calibration = orthographic_calibration(volume_mm, size, px_per_mm);
  // The terms xz, xzz and yz, yzz of kExponents.
  calibration.texture_u_px.coefficients[6] = -px_per_mm / distance_mm;
  calibration.texture_u_px.coefficients[15] = px_per_mm / (distance_mm * distance_mm);
  calibration.texture_v_px.coefficients[8] = -px_per_mm / distance_mm;
  calibration.texture_v_px.coefficients[18] = px_per_mm / (distance_mm * distance_mm);
  return calibration;
}

}  // namespace flytri::testing
