#include "core/meshing/close_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core/geometry/mesh_normals.h"
#include "core/meshing/hole_patch.h"
#include "core/meshing/mesh_topology.h"

namespace flytri::meshing {
namespace {

/// The time of the triangulation grows with the third power.
constexpr std::size_t kMostRimVertices = 400;

/// What lies around one hole.
struct Surroundings {
  std::vector<std::uint32_t> rim;  ///< vertices, counter-clockwise around the hole from outside
  std::vector<char> is_edge;       ///< of two corners of the rim, see least_area_patch
  OuterNeighbors outer;
};

/// The triangles at each vertex of the rims, found once for all holes.
using Stars = std::map<std::uint32_t, std::vector<std::uint32_t>>;

Stars stars_of(const TriangleMesh& mesh, const std::vector<BoundaryLoop>& holes) {
  Stars stars;
  for (const BoundaryLoop& hole : holes) {
    for (const std::uint32_t v : hole.vertices) stars[v];
  }
  std::vector<char> is_rim(mesh.vertices.size(), 0);
  for (const auto& [v, star] : stars) is_rim[v] = 1;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (is_rim[v] != 0) stars[v].push_back(t);
    }
  }
  return stars;
}

Surroundings surroundings_of(const TriangleMesh& mesh, const BoundaryLoop& hole,
                             const Stars& stars) {
  Surroundings around;
  // The line runs along its triangles; the patch lies on its other side.
  around.rim.assign(hole.vertices.rbegin(), hole.vertices.rend());
  const std::size_t count = around.rim.size();
  std::map<std::uint32_t, std::size_t> at;
  for (std::size_t i = 0; i < count; ++i) at[around.rim[i]] = i;
  around.is_edge.assign(count * count, 0);
  around.outer.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::uint32_t> neighbors;
    for (const std::uint32_t t : stars.at(around.rim[i])) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        if (v != around.rim[i]) neighbors.push_back(v);
      }
    }
    std::sort(neighbors.begin(), neighbors.end());
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    for (const std::uint32_t v : neighbors) {
      const auto on_rim = at.find(v);
      if (on_rim != at.end()) around.is_edge[i * count + on_rim->second] = 1;
      // The patch has the edges of the rim itself.
      const bool is_next = on_rim != at.end() && (on_rim->second == (i + 1) % count ||
                                                  on_rim->second == (i + count - 1) % count);
      if (!is_next) around.outer[i].emplace_back(mesh.vertices[v].position_mm.cast<double>());
    }
  }
  return around;
}

/// The colors of the rim, the nearer the more.
Rgb color_between(const TriangleMesh& mesh, const std::vector<std::uint32_t>& rim,
                  const Vec3f& place_mm) {
  Vec3f sum = Vec3f::Zero();
  float weights = 0.0F;
  for (const std::uint32_t v : rim) {
    const SurfacePoint& point = mesh.vertices[v];
    const float weight = 1.0F / std::max((point.position_mm - place_mm).squaredNorm(), 1e-12F);
    sum += weight * Vec3f(point.color[0], point.color[1], point.color[2]);
    weights += weight;
  }
  Rgb color;
  for (int i = 0; i < 3; ++i)
    color[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(sum[i] / weights));
  return color;
}

void add_patch(TriangleMesh& mesh, const Surroundings& around, const HolePatch& patch) {
  const std::vector<std::uint32_t>& rim = around.rim;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto count = static_cast<std::uint32_t>(rim.size());
  const auto vertex_of = [&](std::uint32_t corner) {
    return corner < count ? rim[corner] : first + corner - count;
  };
  TriangleMesh alone;
  for (const Vec3& p : patch.corners_mm)
    alone.vertices.emplace_back().position_mm = p.cast<float>();
  alone.triangles = patch.triangles;
  compute_vertex_normals(alone);
  for (std::size_t corner = count; corner < alone.vertices.size(); ++corner) {
    SurfacePoint& point = alone.vertices[corner];
    point.color = color_between(mesh, rim, point.position_mm);
    point.sigma_mm = std::numeric_limits<float>::infinity();
    mesh.vertices.push_back(point);
  }
  for (const Triangle& t : patch.triangles)
    mesh.triangles.push_back({vertex_of(t[0]), vertex_of(t[1]), vertex_of(t[2])});
}

bool close_hole(TriangleMesh& mesh, const BoundaryLoop& hole, const Stars& stars) {
  const Surroundings around = surroundings_of(mesh, hole, stars);
  std::vector<Vec3> rim_mm;
  rim_mm.reserve(around.rim.size());
  for (const std::uint32_t v : around.rim)
    rim_mm.emplace_back(mesh.vertices[v].position_mm.cast<double>());
  std::optional<HolePatch> patch = least_area_patch(rim_mm, around.is_edge);
  if (!patch) return false;
  refine_patch(*patch, around.is_edge, rim_mm.size());
  fair_patch(*patch, around.outer);
  add_patch(mesh, around, *patch);
  return true;
}

}  // namespace

std::size_t close_holes(TriangleMesh& mesh, double max_width_mm) {
  if (!(max_width_mm > 0.0)) return 0;
  std::vector<BoundaryLoop> holes = find_boundaries(mesh);
  std::erase_if(holes, [&](const BoundaryLoop& loop) {
    return loop.is_outer || loop.width_mm > max_width_mm || loop.vertices.size() > kMostRimVertices;
  });
  const Stars stars = stars_of(mesh, holes);
  std::size_t closed = 0;
  for (const BoundaryLoop& hole : holes) {
    if (close_hole(mesh, hole, stars)) ++closed;
  }
  return closed;
}

}  // namespace flytri::meshing
