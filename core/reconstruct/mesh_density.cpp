#include "core/reconstruct/mesh_density.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/geometry/mesh_normals.h"
#include "core/meshing/mesh_topology.h"

namespace flytri::reconstruct {
namespace {

/// Vertices farther apart get larger bounds, mm. Those of a jaw are 0.1 mm apart.
constexpr double kFineSpacing_mm = 0.2;

double area_mm2(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += area_vector_mm2(mesh, t).norm();
  return area;
}

/// Edge of a texel on the surface, in the mean; 0 without a texture.
double texel_mm(const TexturedMesh& model) {
  if (model.atlas.empty()) return 0.0;
  const Eigen::Vector2d size_px(model.atlas.cols, model.atlas.rows);
  double area_px2 = 0.0;
  for (const Triangle& t : model.mesh.triangles) {
    const auto px = [&](std::size_t k) {
      return Eigen::Vector2d(model.uv[t[k]].cast<double>().cwiseProduct(size_px));
    };
    const Eigen::Vector2d u = px(1) - px(0), v = px(2) - px(0);
    area_px2 += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
  }
  return area_px2 > 0.0 ? std::sqrt(area_mm2(model.mesh) / area_px2) : 0.0;
}

/// Spacing of the vertices of a full mesh: a square of four has two triangles.
double spacing_mm(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0.0;
  return std::sqrt(2.0 * area_mm2(mesh) / static_cast<double>(mesh.triangles.size()));
}

/// The model with other triangles, and without the vertices that these do not use.
TexturedMesh with_triangles(const TexturedMesh& model, std::vector<Triangle> triangles) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> index(model.mesh.vertices.size(), kUnused);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) index[v] = 0;
  }
  TexturedMesh less;
  less.atlas = model.atlas;
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (index[v] == kUnused) continue;
    index[v] = static_cast<std::uint32_t>(less.mesh.vertices.size());
    less.mesh.vertices.push_back(model.mesh.vertices[v]);
    if (!model.uv.empty()) less.uv.push_back(model.uv[v]);
  }
  less.mesh.triangles = std::move(triangles);
  for (Triangle& t : less.mesh.triangles) {
    for (std::uint32_t& v : t) v = index[v];
  }
  return less;
}

}  // namespace

std::string_view to_string(MeshDensity density) {
  switch (density) {
    case MeshDensity::kFull:
      return "full";
    case MeshDensity::kCad:
      return "cad";
    case MeshDensity::kLight:
      return "light";
  }
  return "";
}

meshing::SimplifyOptions simplify_options(MeshDensity density, double spacing_mm, double texel_mm) {
  meshing::SimplifyOptions options;
  const double scale = std::max(1.0, spacing_mm / kFineSpacing_mm);
  options.max_rms_mm = scale * (density == MeshDensity::kLight ? 0.010 : 0.002);
  options.max_mm = scale * (density == MeshDensity::kLight ? 0.050 : 0.010);
  // The margin around a chart is wider than a texel; 15 degrees are no sliver yet.
  options.max_seam_mm = std::max(options.max_mm, texel_mm);
  options.least_angle_rad = 0.26;
  return options;
}

Result<ModelAtDensity> at_density(const TexturedMesh& model, MeshDensity density,
                                  const Progress& progress) {
  ModelAtDensity result;
  result.density = density;
  if (density == MeshDensity::kFull) {
    result.model = model;
    progress.advance();
  } else {
    const meshing::SimplifyOptions options =
        simplify_options(density, spacing_mm(model.mesh), texel_mm(model));
    Result<meshing::Simplified> simplified = meshing::simplify(model.mesh, options, progress);
    if (!simplified) return tl::unexpected(simplified.error());
    result.model = with_triangles(model, std::move(simplified->triangles));
    result.rms_mm = simplified->rms_mm;
    result.max_mm = simplified->max_mm;
  }
  result.uncut = meshing::welded(result.model.mesh);
  meshing::repair_manifold(result.uncut);
  return result;
}

}  // namespace flytri::reconstruct
