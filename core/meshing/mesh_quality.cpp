#include "core/meshing/mesh_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/geometry/mesh_normals.h"
#include "core/meshing/half_edges.h"
#include "core/meshing/least_angle.h"
#include "core/meshing/mesh_topology.h"

namespace flytri::meshing {
namespace {

void judge_shapes(const TriangleMesh& mesh, MeshQuality& quality) {
  std::size_t slivers = 0;
  double least_sine = 1.0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) {
      return Vec3(mesh.vertices[t[k]].position_mm.cast<double>());
    };
    const std::array<double, 3> sides = {(corner(1) - corner(0)).norm(),
                                         (corner(2) - corner(1)).norm(),
                                         (corner(0) - corner(2)).norm()};
    const Vec3 area = area_vector_mm2(mesh, t);
    const double product = sides[0] * sides[1] * sides[2];
    const double perimeter = sides[0] + sides[1] + sides[2];
    // R = abc / 4A, r = 2A / (a + b + c).
    const double squared = 16.0 * area.squaredNorm();
    quality.worst_aspect =
        std::max(quality.worst_aspect, squared > 0.0 ? product * perimeter / squared
                                                     : std::numeric_limits<double>::infinity());
    const double sine = sine_of_least_angle(corner(0), corner(1), corner(2));
    least_sine = std::min(least_sine, sine);
    if (sine < std::sin(kSliverAngle_rad)) ++slivers;
    const Vec3f normals =
        mesh.vertices[t[0]].normal + mesh.vertices[t[1]].normal + mesh.vertices[t[2]].normal;
    if (area.dot(normals.cast<double>()) < 0.0) ++quality.turned;
  }
  quality.least_angle_rad = std::asin(std::min(least_sine, 1.0));
  quality.sliver_share = static_cast<double>(slivers) /
                         static_cast<double>(std::max<std::size_t>(1, quality.triangles));
}

void judge_edges(const TriangleMesh& mesh, MeshQuality& quality) {
  const std::vector<HalfEdge> edges = half_edges_of(mesh);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].same_edge(edges[begin])) ++end;
    if (end - begin > 2) quality.is_manifold = false;
    if (end - begin == 2 && edges[begin].rising == edges[begin + 1].rising)
      quality.is_oriented = false;
  }
}

/// Counts pieces, and fans: at a manifold there is one for each vertex.
void judge_vertices(const TriangleMesh& mesh, MeshQuality& quality) {
  std::vector<char> is_used(mesh.vertices.size(), 0);
  DisjointSets fans = fans_of(mesh), pieces = pieces_of(mesh);
  std::size_t fan_count = 0;
  for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    is_used[mesh.triangles[corner / 3][corner % 3]] = 1;
    if (fans.find(corner) == corner) ++fan_count;
  }
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (is_used[v] == 0) continue;
    ++quality.vertices;
    if (pieces.find(v) == v) ++quality.components;
    if (std::isinf(mesh.vertices[v].sigma_mm)) ++quality.not_measured;
  }
  if (fan_count != quality.vertices) quality.is_manifold = false;
}

}  // namespace

MeshQuality mesh_quality(const TriangleMesh& mesh) {
  MeshQuality quality;
  quality.triangles = mesh.triangles.size();
  judge_shapes(mesh, quality);
  judge_edges(mesh, quality);
  judge_vertices(mesh, quality);
  quality.boundaries = boundary_lines(mesh).size();
  return quality;
}

}  // namespace flytri::meshing
