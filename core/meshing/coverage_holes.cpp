#include "core/meshing/coverage_holes.h"

#include <algorithm>

namespace flytri::meshing {

std::vector<BoundaryLoop> coverage_holes(std::vector<BoundaryLoop> boundaries,
                                         double least_width_mm) {
  std::erase_if(boundaries, [&](const BoundaryLoop& loop) {
    return loop.is_outer || loop.width_mm < least_width_mm;
  });
  std::stable_sort(
      boundaries.begin(), boundaries.end(),
      [](const BoundaryLoop& a, const BoundaryLoop& b) { return a.width_mm > b.width_mm; });
  return boundaries;
}

}  // namespace flytri::meshing
