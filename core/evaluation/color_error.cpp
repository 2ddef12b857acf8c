#include "core/evaluation/color_error.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "core/base/median.h"
#include "core/geometry/point_grid.h"
#include "core/texture/srgb.h"
#include "core/texture/vertex_colors.h"

namespace flytri::evaluation {
namespace {

/// Mean over the channels.
double srgb_difference(const Rgb& a, const Rgb& b) {
  int sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += std::abs(int{a[c]} - int{b[c]});
  return sum / 3.0;
}

Vec3f chromaticity(const Rgb& color) {
  const Vec3f light(texture::linear_from_srgb(color[0]), texture::linear_from_srgb(color[1]),
                    texture::linear_from_srgb(color[2]));
  return light / std::max(light.sum(), 1e-6F);
}

}  // namespace

ColorError color_error(const TexturedMesh& result, const TriangleMesh& truth, double within_mm,
                       const Workers& workers) {
  std::vector<Vec3f> places;
  for (const SurfacePoint& vertex : truth.vertices) places.push_back(vertex.position_mm);
  if (places.empty()) return {};
  const auto reach_mm = static_cast<float>(within_mm);
  const PointGrid grid(places, reach_mm);
  // Vertices that are far apart in the list are usually far apart on the surface.
  const std::size_t elsewhere = truth.vertices.size() / 2;
  std::vector<double> here(result.mesh.vertices.size(), -1.0);
  std::vector<double> there(here);
  std::vector<double> srgb(here.size(), 0.0);
  workers.for_each(
      here.size(),
      [&](std::size_t i) {
        const auto nearest = grid.nearest(result.mesh.vertices[i].position_mm, reach_mm);
        if (!nearest) return;
        const Rgb color = texture::vertex_color(result, i);
        const Vec3f found = chromaticity(color);
        const auto difference = [&](std::size_t j) {
          return static_cast<double>(
              (found - chromaticity(truth.vertices[j].color)).cwiseAbs().maxCoeff());
        };
        here[i] = difference(nearest->index);
        srgb[i] = srgb_difference(color, truth.vertices[nearest->index].color);
        there[i] = difference((i * 7919 + elsewhere) % truth.vertices.size());
      },
      256);
  std::erase_if(here, [](double value) { return value < 0.0; });
  std::erase_if(there, [](double value) { return value < 0.0; });
  ColorError error;
  error.count = static_cast<std::int64_t>(here.size());
  if (here.empty()) return error;
  // Vertices without a near true vertex have zero in `srgb`.
  error.mean_srgb =
      std::accumulate(srgb.begin(), srgb.end(), 0.0) / static_cast<double>(here.size());
  std::sort(here.begin(), here.end());
  std::sort(there.begin(), there.end());
  error.median = quantile_of(here, 0.5);
  error.percentile_95 = quantile_of(here, 0.95);
  error.median_by_chance = quantile_of(there, 0.5);
  return error;
}

}  // namespace flytri::evaluation
