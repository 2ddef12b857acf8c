/// @file  Calibration of a texture camera without perspective, for tests and benchmarks.
#pragma once

#include "core/calibration/record/calibration.h"

namespace flytri::testing {

/// The camera looks along z; x = y = 0 is the middle of the image.
inline calibration::Calibration orthographic_calibration(const Vec3& volume_mm, ImageSize size,
                                                         double px_per_mm) {
  calibration::Calibration calibration;
  calibration.volume.size_mm = volume_mm;
  calibration.texture_size = size;
  // Terms in the order of kExponents: 1, a, b, c, ...
  calibration.texture_u_px.coefficients[0] = 0.5 * size.width_px;
  calibration.texture_u_px.coefficients[1] = px_per_mm;
  calibration.texture_v_px.coefficients[0] = 0.5 * size.height_px;
  calibration.texture_v_px.coefficients[2] = px_per_mm;
  return calibration;
}

}  // namespace flytri::testing
