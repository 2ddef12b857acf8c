#include "ui/scene/mesh_surfels.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/random.h"
#include "ui/scene/surfel_grid.h"

namespace flytri::ui {
namespace {

double area_mm2(const TriangleMesh& mesh) {
  double sum_mm2 = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3f& a = mesh.vertices[t[0]].position_mm;
    const Vec3f b = mesh.vertices[t[1]].position_mm - a, c = mesh.vertices[t[2]].position_mm - a;
    sum_mm2 += 0.5 * static_cast<double>(b.cross(c).norm());
  }
  return sum_mm2;
}

/// 0 to count - 1 in random order.
std::vector<std::uint32_t> random_order(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  Random random(1);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

}  // namespace

SurfelModel surfels_of(const TexturedMesh& mesh, const std::vector<Coverage>& coverage) {
  const std::vector<SurfacePoint>& vertices = mesh.mesh.vertices;
  if (vertices.empty() || mesh.mesh.triangles.empty()) return {};
  const auto spacing_mm =
      static_cast<float>(std::sqrt(area_mm2(mesh.mesh) / static_cast<double>(vertices.size())));
  GrowingBlocks blocks;
  for (const std::uint32_t i : random_order(vertices.size())) {
    const SurfacePoint& vertex = vertices[i];
    Surfel surfel;
    surfel.position_mm = vertex.position_mm;
    surfel.normal = vertex.normal;
    surfel.radius_mm = spacing_mm;
    surfel.sigma_mm = vertex.sigma_mm;
    surfel.color = vertex.color;
    surfel.textured = true;
    surfel.coverage = coverage[i];
    add_to_block(surfel, kBlockCells * spacing_mm, blocks);
  }
  return model_of(blocks);
}

}  // namespace flytri::ui
