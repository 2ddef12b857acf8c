/// @file  Selects the holes of a surface that should be scanned.
#pragma once

#include <vector>

#include "core/meshing/surface_mesh.h"

namespace flytri::meshing {

/// Narrower holes need no scan: the surface around shows their shape, and CAD programs close them.
inline constexpr double kLeastHoleWidth_mm = 0.5;

/// The holes to scan: at least kLeastHoleWidth_mm wide, without the outer borders; widest first.
[[nodiscard]] std::vector<BoundaryLoop> coverage_holes(std::vector<BoundaryLoop> boundaries);

}  // namespace flytri::meshing
