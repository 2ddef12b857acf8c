/// @file  Selects the holes of a surface that should be scanned.
#pragma once

#include <vector>

#include "core/meshing/surface_mesh.h"

namespace flytri::meshing {

/// Of a sensor for teeth. Its lines lie about 2 mm apart, so they meet a narrower hole only by
/// chance. Such a hole needs no scan: the surface around shows its shape, and CAD programs close
/// it.
inline constexpr double kLeastHoleWidth_mm = 1.0;

/// The holes to scan, without the outer borders; widest first.
/// @param least_width_mm  kLeastHoleWidth_mm times calibration::line_distance_factor()
[[nodiscard]] std::vector<BoundaryLoop> coverage_holes(std::vector<BoundaryLoop> boundaries,
                                                       double least_width_mm = kLeastHoleWidth_mm);

}  // namespace flytri::meshing
