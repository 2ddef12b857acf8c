/// @file  How a measured point moves if the projector of its line has moved.
#pragma once

#include <cmath>

#include "core/geometry/rigid.h"

namespace flytri::refinement {

/// A measured point lies where the camera's ray meets the light sheet. If the sheet moves, the
/// point moves along that ray.
struct SheetShift {
  Vec3 ray;         ///< unit vector, sensor frame
  Twist per_twist;  ///< its product with the projector's twist: how far the point moves, mm
};

/// @param p_mm          the point, sensor frame
/// @param sheet_normal  unit normal of the light sheet, sensor frame
/// @param p_camera_mm   projection center of the camera, sensor frame
[[nodiscard]] inline SheetShift sheet_shift(const Vec3& p_mm, const Vec3& sheet_normal,
                                            const Vec3& p_camera_mm) {
  SheetShift shift{(p_mm - p_camera_mm).normalized(), Twist::Zero()};
  // A ray in the sheet meets it nowhere; no sensor that can measure has one.
  constexpr double kLeastSine = 0.02;
  const double sine = sheet_normal.dot(shift.ray);
  if (std::abs(sine) < kLeastSine) return shift;
  shift.per_twist << p_mm.cross(sheet_normal) / sine, sheet_normal / sine;
  return shift;
}

/// The true place of a measured point after a motion of its projector.
/// @param motion  since the calibration, about the sensor's origin, sensor frame
[[nodiscard]] inline Vec3 seen_with(const Twist& motion, const Vec3& p_mm, const Vec3& sheet_normal,
                                    const Vec3& p_camera_mm) {
  const SheetShift shift = sheet_shift(p_mm, sheet_normal, p_camera_mm);
  return p_mm + shift.per_twist.dot(motion) * shift.ray;
}

}  // namespace flytri::refinement
