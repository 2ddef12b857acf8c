#include "ui/scene/mesh_coverage.h"

#include <algorithm>

#include "core/geometry/point_grid.h"

namespace flytri::ui {

std::vector<Coverage> coverage_of(const TriangleMesh& mesh, const SurfelModel& scanned) {
  /// Surfels of neighboring cells lie at most about two radii apart.
  constexpr float kReachRadii = 3.0F;
  std::vector<Vec3f> places_mm;
  std::vector<Coverage> coverage;
  float radius_mm = 0.0F;
  for (const auto& block : scanned) {
    for (const Surfel& surfel : block->surfels) {
      places_mm.push_back(surfel.position_mm);
      coverage.push_back(surfel.coverage);
      radius_mm = std::max(radius_mm, surfel.radius_mm);
    }
  }
  if (places_mm.empty()) return std::vector(mesh.vertices.size(), Coverage::kGood);
  const float reach_mm = kReachRadii * radius_mm;
  const PointGrid grid(places_mm, reach_mm);
  std::vector<Coverage> by_vertex;
  by_vertex.reserve(mesh.vertices.size());
  for (const SurfacePoint& vertex : mesh.vertices) {
    const auto near = grid.nearest(vertex.position_mm, reach_mm);
    by_vertex.push_back(near ? coverage[near->index] : Coverage::kThin);
  }
  return by_vertex;
}

}  // namespace flytri::ui
