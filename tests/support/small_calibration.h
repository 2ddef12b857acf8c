/// @file  A calibration with few numbers, as a plausible sensor would have it.
#pragma once

#include "core/calibration/record/calibration.h"

namespace flytri::testing {

/// Pixel (2.5, 2) of 6 x 5 sees the middle of 20 x 15 x 15 mm. Two lines a pattern, calibrated in
/// some rows only.
inline calibration::Calibration small_calibration() {
  calibration::Calibration calibration;
  calibration.volume.size_mm = {20, 15, 15};
  calibration.measurement_size = {6, 5};
  calibration.texture_size = {8, 7};
  const auto cubic = [](const Vec3& center, const Vec3& half_range) {
    calibration::TrivariateCubic result;
    result.center = center;
    result.half_range = half_range;
    for (int i = 0; i < 20; ++i)
      result.coefficients[std::size_t(i)] = i / 1024.0;  // exact in ten digits
    result.residual = {0.25, 0.5, 77};
    return result;
  };
  calibration.x_mm = calibration.y_mm = cubic({2.5, 2.0, 0.125}, {2.5, 2.0, 7.5});
  calibration.x_mm.coefficients[1] = 8.0;
  calibration.y_mm.coefficients[2] = 6.0;
  calibration.texture_u_px = calibration.texture_v_px = cubic(Vec3::Zero(), {10, 7.5, 7.5});
  calibration.texture_u_px.coefficients[0] = 3.5;
  calibration.texture_u_px.coefficients[1] = 3.0;
  calibration.texture_v_px.coefficients[0] = 3.0;
  calibration.texture_v_px.coefficients[2] = 2.5;
  for (const Pattern pattern : kPatterns) {
    calibration::PatternCalibration& lines = calibration.of(pattern);
    lines.depth_residual_mm = {0.001953125, 0.015625, 1234};
    lines.width_residual_px = {0.03125, 0.25, 1234};
    lines.lines.assign(2, std::vector<calibration::LineRow>(pattern == Pattern::kVertical ? 5 : 6));
    lines.sheet_normals = {Vec3::UnitX(), Vec3::UnitY()};
    for (std::size_t n = 0; n < 2; ++n) {
      const double middle = n == 0 ? 10.0 : -10.0;  // depth in the middle of the image
      for (std::size_t along : {1, 2, 4}) {
        lines.lines[n][along] = {{2.25, 2.0, {middle, 20.0, 0.125, 0.25}},
                                 {2.25, 2.0, {2, 0.5, 0.25}},
                                 n == 0 ? 0.5 : 2.5,
                                 n == 0 ? 2.0 : 4.0};
      }
    }
  }
  return calibration;
}

}  // namespace flytri::testing
