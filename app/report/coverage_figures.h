/// @file  How much of a jaw was measured, and how well.
#pragma once

#include <cstddef>

#include "core/geometry/triangle_mesh.h"

namespace flytri::report {

struct CoverageFigures {
  double surface_mm2 = 0.0;
  /// Standard uncertainty of the measured vertices along the normal: median and 95 % point.
  double sigma_median_mm = 0.0, sigma_95_mm = 0.0;
  std::size_t not_measured = 0;  ///< vertices of closed holes
};

[[nodiscard]] CoverageFigures coverage_figures(const TriangleMesh& mesh);

}  // namespace flytri::report
