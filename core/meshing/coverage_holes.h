/// @file  Which rims of a measured surface are holes that a dentist would scan.
#pragma once

#include <vector>

#include "core/meshing/surface_mesh.h"

namespace flytri::meshing {

/// Narrower holes tell nothing new: what lies around them shows their shape, and CAD programs
/// close them.
inline constexpr double kLeastHoleWidth_mm = 0.5;

/// The holes that are worth a scan: at least kLeastHoleWidth_mm wide, no border of the scan, the
/// widest first.
[[nodiscard]] std::vector<BoundaryLoop> coverage_holes(std::vector<BoundaryLoop> boundaries);

}  // namespace flytri::meshing
