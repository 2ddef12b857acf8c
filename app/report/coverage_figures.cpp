#include "app/report/coverage_figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace flytri::report {

CoverageFigures coverage_figures(const TriangleMesh& mesh) {
  CoverageFigures figures;
  for (const Triangle& t : mesh.triangles) {
    const Vec3f &a = mesh.vertices[t[0]].position_mm, &b = mesh.vertices[t[1]].position_mm,
                &c = mesh.vertices[t[2]].position_mm;
    figures.surface_mm2 += 0.5 * static_cast<double>((b - a).cross(c - a).norm());
  }
  std::vector<double> sigmas_mm;
  for (const SurfacePoint& vertex : mesh.vertices) {
    if (std::isfinite(vertex.sigma_mm)) {
      sigmas_mm.push_back(static_cast<double>(vertex.sigma_mm));
    } else {
      ++figures.not_measured;
    }
  }
  if (sigmas_mm.empty()) return figures;
  const auto at = [&](double share) {
    const auto place =
        static_cast<std::ptrdiff_t>(share * static_cast<double>(sigmas_mm.size() - 1));
    std::nth_element(sigmas_mm.begin(), sigmas_mm.begin() + place, sigmas_mm.end());
    return sigmas_mm[static_cast<std::size_t>(place)];
  };
  figures.sigma_median_mm = at(0.5);
  figures.sigma_95_mm = at(0.95);
  return figures;
}

}  // namespace flytri::report
