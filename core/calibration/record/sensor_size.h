/// @file  What the size of a sensor's measurement volume says of what it is for.
#pragma once

#include "core/geometry/rigid.h"

namespace flytri::calibration {

/// True if a sensor is for teeth: its volume fits into a mouth. Else it is for faces.
[[nodiscard]] inline bool fits_mouth(const Vec3& volume_mm) { return volume_mm.x() < 60.0; }

/// Distance of a sensor's lines, relative to that of a sensor for teeth (about 2 mm); 1 for every
/// sensor for teeth.
[[nodiscard]] inline double line_distance_factor(const Vec3& volume_mm) {
  constexpr double kIntraoralWidth_mm = 20.0;
  return fits_mouth(volume_mm) ? 1.0 : volume_mm.x() / kIntraoralWidth_mm;
}

/// Lines meet a narrower hole only by chance. It needs no scan: the surface around shows its shape,
/// and CAD programs close it.
[[nodiscard]] inline double least_hole_width_mm(const Vec3& volume_mm) {
  constexpr double kOfTeeth_mm = 1.0;
  return kOfTeeth_mm * line_distance_factor(volume_mm);
}

}  // namespace flytri::calibration
