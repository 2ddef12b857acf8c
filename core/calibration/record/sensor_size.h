/// @file  What the size of a sensor's measurement volume says of what it is for.
#pragma once

#include "core/geometry/rigid.h"

namespace flytri::calibration {

/// True if a sensor is for teeth: its volume fits into a mouth. Else it is for faces.
[[nodiscard]] inline bool fits_mouth(const Vec3& volume_mm) { return volume_mm.x() < 60.0; }

/// Distance between a sensor's lines, divided by that of sensors for teeth (about 2 mm); 1 for
/// these.
[[nodiscard]] inline double line_distance_factor(const Vec3& volume_mm) {
  constexpr double kIntraoralWidth_mm = 20.0;
  return fits_mouth(volume_mm) ? 1.0 : volume_mm.x() / kIntraoralWidth_mm;
}

/// Narrower holes need not be scanned: lines seldom reach them, and CAD programs close them.
[[nodiscard]] inline double least_hole_width_mm(const Vec3& volume_mm) {
  constexpr double kOfTeeth_mm = 1.0;
  return kOfTeeth_mm * line_distance_factor(volume_mm);
}

}  // namespace flytri::calibration
