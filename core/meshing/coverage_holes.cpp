#include "core/meshing/coverage_holes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flytri {

double hole_width_mm(const BoundaryLoop& hole) {
  return 2.0 * std::sqrt(std::max(hole.area_mm2, 0.0) / std::numbers::pi);
}

std::vector<BoundaryLoop> coverage_holes(std::vector<BoundaryLoop> boundaries) {
  std::erase_if(boundaries, [](const BoundaryLoop& loop) {
    return loop.is_outer || hole_width_mm(loop) < kLeastHoleWidth_mm;
  });
  std::stable_sort(
      boundaries.begin(), boundaries.end(),
      [](const BoundaryLoop& a, const BoundaryLoop& b) { return a.area_mm2 > b.area_mm2; });
  return boundaries;
}

}  // namespace flytri
