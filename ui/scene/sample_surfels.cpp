#include "ui/scene/sample_surfels.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/base/random.h"
#include "core/geometry/cell_key.h"
#include "ui/scene/surfel_grid.h"

namespace flytri::ui {
namespace {

/// Up to each triangle, the area of all before it and its own.
std::vector<double> area_sums(const TriangleMesh& mesh) {
  std::vector<double> sums;
  sums.reserve(mesh.triangles.size());
  double sum_mm2 = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3f& a = mesh.vertices[t[0]].position_mm;
    const Vec3f b = mesh.vertices[t[1]].position_mm - a, c = mesh.vertices[t[2]].position_mm - a;
    sums.push_back(sum_mm2 += 0.5 * static_cast<double>(b.cross(c).norm()));
  }
  return sums;
}

/// A place of a triangle, any as likely as any other.
Surfel surfel_at(const TriangleMesh& mesh, const Triangle& triangle, Random& random) {
  double u = random.uniform(), v = random.uniform();
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const std::array<float, 3> weights = {static_cast<float>(1.0 - u - v), static_cast<float>(u),
                                        static_cast<float>(v)};
  Surfel surfel;
  surfel.normal.setZero();
  Eigen::Array3f color = Eigen::Array3f::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const SurfacePoint& vertex = mesh.vertices[triangle[corner]];
    surfel.position_mm += weights[corner] * vertex.position_mm;
    surfel.normal += weights[corner] * vertex.normal;
    color += weights[corner] * Eigen::Array3f(vertex.color[0], vertex.color[1], vertex.color[2]);
  }
  surfel.normal.normalize();
  for (int c = 0; c < 3; ++c) {
    surfel.color[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(color[c]));
  }
  surfel.textured = true;
  surfel.coverage = Coverage::kGood;
  return surfel;
}

/// The mean of what fell into one cell of the thinning grid.
struct Mean {
  Surfel first;
  Vec3f position_sum_mm = Vec3f::Zero();
  Vec3f normal_sum = Vec3f::Zero();
  float count = 0.0F;

  void add(const Surfel& surfel) {
    if (count == 0.0F) first = surfel;
    position_sum_mm += surfel.position_mm;
    normal_sum += surfel.normal;
    count += 1.0F;
  }
  [[nodiscard]] Surfel surfel(float radius_mm) const {
    Surfel mean = first;
    mean.position_mm = position_sum_mm / count;
    mean.normal = normal_sum.normalized();
    mean.radius_mm = radius_mm;
    return mean;
  }
};

}  // namespace

SurfelModel sample_surfels(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  /// Points to a cell: few cells that the surface crosses stay empty.
  constexpr std::size_t kPointsPerSurfel = 6;
  /// As the live surface has it.
  constexpr float kRadiusCells = 0.85F;
  const std::vector<double> sums = area_sums(mesh);
  if (sums.empty() || count == 0) return {};
  // A surface in any direction crosses 1.5 cells of a cubic grid for each face's area of its own;
  // a sixth of them only so little that no point falls there.
  const auto cell_mm =
      static_cast<float>(std::sqrt(1.25 * sums.back() / static_cast<double>(count)));
  Random random(seed);
  std::unordered_map<CellKey, std::size_t> cells;
  std::vector<Mean> means;
  for (std::size_t i = 0; i < count * kPointsPerSurfel; ++i) {
    const auto at = std::upper_bound(sums.begin(), sums.end() - 1, random.uniform() * sums.back());
    const auto triangle = static_cast<std::size_t>(at - sums.begin());
    const Surfel surfel = surfel_at(mesh, mesh.triangles[triangle], random);
    const auto [cell, is_new] =
        cells.try_emplace(CellKey::at(surfel.position_mm, cell_mm), means.size());
    if (is_new) means.emplace_back();
    means[cell->second].add(surfel);
  }
  // Points came at random, so cells are in random order as well.
  GrowingBlocks blocks;
  for (const Mean& mean : means) {
    add_to_block(mean.surfel(kRadiusCells * cell_mm), kBlockCells * cell_mm, blocks);
  }
  return model_of(blocks);
}

}  // namespace flytri::ui
