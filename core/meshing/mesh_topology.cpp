#include "core/meshing/mesh_topology.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "core/geometry/mesh_normals.h"
#include "core/meshing/half_edges.h"
#include "core/meshing/widest_place.h"

namespace flytri::meshing {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

void drop_degenerate(TriangleMesh& mesh) {
  std::vector<char> keep(mesh.triangles.size(), 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (area_vector_mm2(mesh, mesh.triangles[t]).norm() <= 0.0) keep[t] = 0;
  }
  keep_triangles(mesh, keep);
}

void drop_crowded_edges(TriangleMesh& mesh) {
  const std::vector<HalfEdge> edges = half_edges_of(mesh);
  std::vector<char> keep(mesh.triangles.size(), 1);
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end].same_edge(edges[begin])) ++end;
    const bool same_sense = end - begin == 2 && edges[begin].rising == edges[begin + 1].rising;
    if (end - begin > 2 || same_sense) {
      for (std::size_t i = begin; i < end; ++i) keep[edges[i].triangle()] = 0;
    }
    begin = end;
  }
  keep_triangles(mesh, keep);
}

int corner_of(const Triangle& triangle, std::uint32_t vertex) {
  return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

/// Mean normal of the vertices of a rim.
Vec3 mean_normal(const TriangleMesh& mesh, const std::vector<std::uint32_t>& rim) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t v : rim) sum += mesh.vertices[v].normal.cast<double>();
  return sum.normalized();
}

/// Mean normal of the rim vertices near a place; of all vertices if none is near.
Vec3 mean_normal_near(const TriangleMesh& mesh, const std::vector<std::uint32_t>& rim,
                      const Vec3& place_mm, double reach_mm) {
  std::vector<std::uint32_t> near;
  std::copy_if(rim.begin(), rim.end(), std::back_inserter(near), [&](std::uint32_t v) {
    return (mesh.vertices[v].position_mm.cast<double>() - place_mm).norm() <= reach_mm;
  });
  return mean_normal(mesh, near.empty() ? rim : near);
}

/// Area vector of a closed line: for a flat line, normal to it, with the enclosed area as length.
Vec3 enclosed_mm2(const std::vector<Vec3>& rim_mm) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < rim_mm.size(); ++i) {
    const Vec3& next = rim_mm[(i + 1) % rim_mm.size()];
    sum += (rim_mm[i] - rim_mm.front()).cross(next - rim_mm.front());
  }
  return 0.5 * sum;
}

/// A boundary loop and its geometry.
struct Rim {
  BoundaryLoop loop;
  std::vector<Vec3> corners_mm;
  Vec3 enclosed_mm2 = Vec3::Zero();
  Eigen::AlignedBox3d box_mm;
};

Rim rim_of(const TriangleMesh& mesh, std::vector<std::uint32_t> vertices) {
  Rim rim;
  rim.corners_mm.reserve(vertices.size());
  for (const std::uint32_t v : vertices) {
    rim.loop.rim_mm.push_back(mesh.vertices[v].position_mm);
    rim.corners_mm.emplace_back(mesh.vertices[v].position_mm.cast<double>());
  }
  for (std::size_t i = 0; i < rim.corners_mm.size(); ++i) {
    const Vec3& next = rim.corners_mm[(i + 1) % rim.corners_mm.size()];
    rim.loop.perimeter_mm += (next - rim.corners_mm[i]).norm();
    rim.box_mm.extend(next);
  }
  rim.enclosed_mm2 = enclosed_mm2(rim.corners_mm);
  rim.loop.area_mm2 = std::abs(rim.enclosed_mm2.dot(mean_normal(mesh, vertices)));
  rim.loop.vertices = std::move(vertices);
  return rim;
}

/// A tooth may be a separate component inside a hole of the gum. The outer borders of components
/// inside a hole, or within a quarter of its size around it, are its islands. An outer border has
/// no islands.
/// @param smaller  all rims with a smaller area
std::vector<std::span<const Vec3>> islands_mm(const Rim& hole, std::span<const Rim> smaller) {
  constexpr double kBackground = 0.25;
  if (hole.loop.is_outer) return {};
  const Vec3 beside = Vec3::Constant(kBackground * hole.box_mm.diagonal().norm());
  const Eigen::AlignedBox3d around(hole.box_mm.min() - beside, hole.box_mm.max() + beside);
  std::vector<std::span<const Vec3>> islands;
  for (const Rim& rim : smaller) {
    if (rim.loop.is_outer && around.contains(rim.box_mm.center()))
      islands.emplace_back(rim.corners_mm);
  }
  return islands;
}

void find_widest_place(const TriangleMesh& mesh, Rim& rim, std::span<const Rim> smaller) {
  BoundaryLoop& loop = rim.loop;
  const WidestPlace widest =
      widest_place(rim.corners_mm, islands_mm(rim, smaller), rim.enclosed_mm2.normalized());
  loop.width_mm = widest.width_mm;
  loop.center_mm = widest.center_mm.cast<float>();
  loop.normal =
      mean_normal_near(mesh, loop.vertices, widest.center_mm, widest.width_mm).cast<float>();
}

/// The next boundary vertex after each vertex, or kNone. A manifold vertex has at most one.
std::vector<std::uint32_t> boundary_successors(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> next(mesh.vertices.size(), kNone);
  const std::vector<HalfEdge> edges = half_edges_of(mesh);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i + 1 < edges.size() && edges[i].same_edge(edges[i + 1])) {
      ++i;
      continue;
    }
    const auto [from, to] = edges[i].rising ? std::pair(edges[i].low, edges[i].high)
                                            : std::pair(edges[i].high, edges[i].low);
    next[from] = to;
  }
  return next;
}

/// Marks the loop with the largest area of each component, the first one here. The length does not
/// work: a ragged crack may be longer than the border.
void mark_outer(const TriangleMesh& mesh, std::vector<Rim>& rims) {
  DisjointSets pieces = pieces_of(mesh);
  std::vector<char> has_border(mesh.vertices.size(), 0);
  for (Rim& rim : rims) {
    char& has = has_border[pieces.find(rim.loop.vertices.front())];
    rim.loop.is_outer = has == 0;
    has = 1;
  }
}

}  // namespace

DisjointSets fans_of(const TriangleMesh& mesh) {
  DisjointSets fans(3 * mesh.triangles.size());
  const std::vector<HalfEdge> edges = half_edges_of(mesh);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (!edges[i].same_edge(edges[i + 1])) continue;
    for (const std::uint32_t v : {edges[i].low, edges[i].high}) {
      const std::uint32_t s = edges[i].triangle();
      const std::uint32_t t = edges[i + 1].triangle();
      fans.join(3 * s + corner_of(mesh.triangles[s], v), 3 * t + corner_of(mesh.triangles[t], v));
    }
  }
  return fans;
}

DisjointSets pieces_of(const TriangleMesh& mesh) {
  DisjointSets pieces(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[1], t[2]);
  }
  return pieces;
}

void split_fans(TriangleMesh& mesh) {
  DisjointSets fans = fans_of(mesh);
  std::vector<std::uint32_t> first_fan(mesh.vertices.size(), kNone);
  std::map<std::uint32_t, std::uint32_t> vertex_of_fan;
  for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    std::uint32_t& v = mesh.triangles[corner / 3][corner % 3];
    const std::uint32_t fan = fans.find(corner);
    if (first_fan[v] == kNone) first_fan[v] = fan;
    if (first_fan[v] == fan) continue;
    const auto [it, is_new] =
        vertex_of_fan.try_emplace(fan, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.push_back(SurfacePoint(mesh.vertices[v]));
      first_fan.push_back(fan);
    }
    v = it->second;
  }
}

void keep_triangles(TriangleMesh& mesh, const std::vector<char>& keep) {
  std::size_t next = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (keep[t] != 0) mesh.triangles[next++] = mesh.triangles[t];
  }
  mesh.triangles.resize(next);
}

void repair_manifold(TriangleMesh& mesh) {
  drop_degenerate(mesh);
  drop_crowded_edges(mesh);
  split_fans(mesh);
}

void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kNone);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) new_index[v] = 0;
  }
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (new_index[v] == kNone) continue;
    mesh.vertices[next] = mesh.vertices[v];
    new_index[v] = next++;
  }
  mesh.vertices.resize(next);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = new_index[v];
  }
}

void drop_islands(TriangleMesh& mesh, double min_area_mm2) {
  DisjointSets pieces = pieces_of(mesh);
  std::vector<double> area(mesh.vertices.size(), 0.0);
  for (const Triangle& t : mesh.triangles)
    area[pieces.find(t[0])] += area_vector_mm2(mesh, t).norm();
  std::vector<char> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    keep[t] = area[pieces.find(mesh.triangles[t][0])] >= min_area_mm2 ? 1 : 0;
  }
  keep_triangles(mesh, keep);
  drop_unused_vertices(mesh);
}

TriangleMesh welded(const TriangleMesh& cut) {
  using Place = std::array<float, 3>;
  TriangleMesh mesh;
  std::map<Place, std::uint32_t> at;
  std::vector<std::uint32_t> vertex_of;
  vertex_of.reserve(cut.vertices.size());
  for (const SurfacePoint& vertex : cut.vertices) {
    const Vec3f& p = vertex.position_mm;
    const auto [entry, is_new] = at.try_emplace(Place{p.x(), p.y(), p.z()},
                                                static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(vertex);
    vertex_of.push_back(entry->second);
  }
  for (const Triangle& t : cut.triangles) {
    mesh.triangles.push_back({vertex_of[t[0]], vertex_of[t[1]], vertex_of[t[2]]});
  }
  return mesh;
}

std::vector<std::vector<std::uint32_t>> boundary_lines(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> next = boundary_successors(mesh);
  std::vector<std::vector<std::uint32_t>> lines;
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == kNone) continue;
    std::vector<std::uint32_t>& line = lines.emplace_back();
    for (std::uint32_t v = start; next[v] != kNone;) {
      line.push_back(v);
      v = std::exchange(next[v], kNone);
    }
  }
  return lines;
}

std::vector<BoundaryLoop> find_boundaries(const TriangleMesh& mesh) {
  std::vector<Rim> rims;
  for (std::vector<std::uint32_t>& line : boundary_lines(mesh))
    rims.push_back(rim_of(mesh, std::move(line)));
  std::stable_sort(rims.begin(), rims.end(),
                   [](const Rim& a, const Rim& b) { return a.loop.area_mm2 > b.loop.area_mm2; });
  mark_outer(mesh, rims);
  std::vector<BoundaryLoop> loops;
  loops.reserve(rims.size());
  for (std::size_t i = 0; i < rims.size(); ++i) {
    find_widest_place(mesh, rims[i], std::span(rims).subspan(i + 1));
    loops.push_back(std::move(rims[i].loop));
  }
  return loops;
}

}  // namespace flytri::meshing
