/// @file  Selects the holes of a surface that should be scanned.
#pragma once

#include <vector>

#include "core/meshing/surface_mesh.h"

namespace flytri::meshing {

/// The holes to scan, without the outer borders; widest first.
/// @param least_width_mm  as calibration::least_hole_width_mm() gives it
[[nodiscard]] std::vector<BoundaryLoop> coverage_holes(std::vector<BoundaryLoop> boundaries,
                                                       double least_width_mm);

}  // namespace flytri::meshing
