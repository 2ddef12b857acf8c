#include "core/meshing/trim_rims.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/geometry/mesh_normals.h"
#include "core/geometry/point_grid.h"
#include "core/meshing/mesh_topology.h"

namespace flytri::meshing {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();
/// A hole with a shorter rim, in strip widths, is smaller across than a strip is wide.
constexpr float kPinholeRim = 2.0F;
/// A pinhole this near to a rim, in strip widths, becomes part of it; so do its neighbors, in so
/// many rounds.
constexpr float kPinholeReach = 0.5F;
constexpr int kPinholeRounds = 3;
/// The disk reaches farther back by so many spacings: the core ends up to one before its true rim,
/// and so does what the disk covers.
constexpr float kBackReachSpacings = 1.5F;
/// Smaller pieces are dropped, in squared strip widths.
constexpr float kLeastPiece = 4.0F;
/// Of the area, at least this share must be left.
constexpr double kLeastShare = 0.5;
/// Lines of the other pattern confirm the surface up to this distance, in strip widths.
constexpr float kCrossingStrips = 0.85F;
constexpr int kRimSmoothings = 10;
/// A rim moves by at most this share of the spacing.
constexpr float kMostRimMotion = 0.5F;

/// The neighbors of each vertex, one after the other.
struct Neighborhood {
  explicit Neighborhood(const TriangleMesh& mesh) : begins(mesh.vertices.size() + 1, 0) {
    const auto for_each_pair = [&](const auto& visit) {
      for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
          visit(t[k], t[(k + 1) % 3]);
          visit(t[(k + 1) % 3], t[k]);
        }
      }
    };
    for_each_pair([&](std::uint32_t from, std::uint32_t) { ++begins[from + 1]; });
    for (std::size_t v = 1; v < begins.size(); ++v) begins[v] += begins[v - 1];
    neighbors.resize(begins.back());
    std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
    for_each_pair([&](std::uint32_t from, std::uint32_t to) { neighbors[next[from]++] = to; });
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t v) const {
    return std::span(neighbors).subspan(begins[v], begins[v + 1] - begins[v]);
  }
  /// True if all neighbors are marked.
  [[nodiscard]] bool all_of(std::uint32_t v, const std::vector<char>& is_marked) const {
    const auto near = of(v);
    return std::all_of(near.begin(), near.end(),
                       [&](std::uint32_t other) { return is_marked[other] != 0; });
  }
  std::vector<std::size_t> begins;
  std::vector<std::uint32_t> neighbors;
};

/// The distance of each vertex from the nearest source, up to a limit, as far as the surface is
/// connected within it. Distances are straight, not along edges: a disk stays round.
std::vector<float> distances_mm(const TriangleMesh& mesh, const Neighborhood& around,
                                const std::vector<char>& is_source, float limit_mm) {
  struct Reached {
    float distance_mm;
    std::uint32_t vertex, source;
    bool operator>(const Reached& other) const {
      return std::tie(distance_mm, vertex, source) >
             std::tie(other.distance_mm, other.vertex, other.source);
    }
  };
  std::vector<float> distances(mesh.vertices.size(), kFar);
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (std::uint32_t v = 0; v < distances.size(); ++v) {
    if (is_source[v] == 0) continue;
    distances[v] = 0.0F;
    if (!around.all_of(v, is_source)) queue.push({0.0F, v, v});
  }
  while (!queue.empty()) {
    const Reached at = queue.top();
    queue.pop();
    if (at.distance_mm > distances[at.vertex]) continue;
    for (const std::uint32_t next : around.of(at.vertex)) {
      const float distance_mm =
          (mesh.vertices[next].position_mm - mesh.vertices[at.source].position_mm).norm();
      if (distance_mm > limit_mm || distance_mm >= distances[next]) continue;
      distances[next] = distance_mm;
      queue.push({distance_mm, next, at.source});
    }
  }
  return distances;
}

float length_mm(const TriangleMesh& mesh, const std::vector<std::uint32_t>& line) {
  float length = 0.0F;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3f &p = mesh.vertices[line[i]].position_mm,
                &next = mesh.vertices[line[(i + 1) % line.size()]].position_mm;
    length += (next - p).norm();
  }
  return length;
}

double area_mm2(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += area_vector_mm2(mesh, t).norm();
  return area;
}

/// Keeps the triangles with three vertices that stay.
template <typename Stays>
void keep_between(TriangleMesh& mesh, const Stays& stays) {
  std::vector<char> keep;
  keep.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    keep.push_back(stays(t[0]) && stays(t[1]) && stays(t[2]) ? 1 : 0);
  keep_triangles(mesh, keep);
}

/// Moves the pinholes near one of the places to the end of the list.
/// @returns the first of them
template <typename Lines>
auto near_to(const TriangleMesh& mesh, Lines& pinholes, const std::vector<Vec3f>& places_mm,
             float reach_mm) {
  const PointGrid places(places_mm, reach_mm);
  return std::stable_partition(pinholes.begin(), pinholes.end(), [&](const auto& line) {
    return std::none_of(line.begin(), line.end(), [&](std::uint32_t v) {
      return places.nearest(mesh.vertices[v].position_mm, reach_mm).has_value();
    });
  });
}

/// The vertices along rims. Pinholes do not count, except near a rim: a scan ends in rows of
/// them.
std::vector<char> rim_vertices(const TriangleMesh& mesh, float strip_mm) {
  std::vector<std::vector<std::uint32_t>> pinholes = boundary_lines(mesh);
  std::vector<char> is_rim(mesh.vertices.size(), 0);
  const auto take = [&](auto first) {
    std::vector<Vec3f> places_mm;
    for (auto line = first; line != pinholes.end(); ++line) {
      for (const std::uint32_t v : *line) {
        is_rim[v] = 1;
        places_mm.push_back(mesh.vertices[v].position_mm);
      }
    }
    pinholes.erase(first, pinholes.end());
    return places_mm;
  };
  std::vector<Vec3f> new_rims_mm = take(
      std::partition(pinholes.begin(), pinholes.end(), [&](const std::vector<std::uint32_t>& line) {
        return length_mm(mesh, line) < kPinholeRim * strip_mm;
      }));
  for (int round = 0; round < kPinholeRounds && !new_rims_mm.empty(); ++round)
    new_rims_mm = take(near_to(mesh, pinholes, new_rims_mm, kPinholeReach * strip_mm));
  return is_rim;
}

/// Marks vertices with lines of both patterns within a distance, and those whose patterns are not
/// known.
std::vector<char> crossed_vertices(const TriangleMesh& mesh, const Neighborhood& around,
                                   float reach_mm, const Workers& workers) {
  std::array<std::vector<float>, kPatterns.size()> from_measured;
  workers.for_each(kPatterns.size(), [&](std::size_t k) {
    std::vector<char> is_measured(mesh.vertices.size());
    std::transform(mesh.vertices.begin(), mesh.vertices.end(), is_measured.begin(),
                   [&](const SurfacePoint& v) {
                     return v.patterns == 0 || (v.patterns & set_of(kPatterns[k])) != 0 ? 1 : 0;
                   });
    from_measured[k] = distances_mm(mesh, around, is_measured, reach_mm);
  });
  std::vector<char> is_crossed(mesh.vertices.size(), 1);
  for (const std::vector<float>& distances : from_measured) {
    for (std::size_t v = 0; v < is_crossed.size(); ++v) {
      if (distances[v] == kFar) is_crossed[v] = 0;
    }
  }
  return is_crossed;
}

/// From the rims inwards, drops what only one pattern measured: the ends of single lines, which
/// nothing confirms.
void drop_uncrossed_rims(TriangleMesh& mesh, float strip_mm, const Workers& workers) {
  const Neighborhood around(mesh);
  const std::vector<char> is_crossed =
      crossed_vertices(mesh, around, kCrossingStrips * strip_mm, workers);
  std::vector<char> is_dropped(mesh.vertices.size(), 0);
  std::vector<std::uint32_t> front;
  const auto visit = [&](std::uint32_t v) {
    if (is_crossed[v] != 0 || std::exchange(is_dropped[v], 1) != 0) return;
    front.push_back(v);
  };
  const std::vector<char> is_rim = rim_vertices(mesh, strip_mm);
  for (std::uint32_t v = 0; v < is_rim.size(); ++v) {
    if (is_rim[v] != 0) visit(v);
  }
  while (!front.empty()) {
    const std::uint32_t v = front.back();
    front.pop_back();
    for (const std::uint32_t next : around.of(v)) visit(next);
  }
  keep_between(mesh, [&](std::uint32_t v) { return is_dropped[v] == 0; });
  split_fans(mesh);
}

/// Opens the surface by a disk: what no disk covers that lies on the surface goes.
void open_by_disk(TriangleMesh& mesh, float strip_mm, float spacing_mm) {
  const std::vector<char> is_rim = rim_vertices(mesh, strip_mm);
  const Neighborhood around(mesh);
  const float radius_mm = 0.5F * strip_mm;
  const std::vector<float> from_rim = distances_mm(mesh, around, is_rim, radius_mm);
  std::vector<char> is_core(mesh.vertices.size());
  for (std::size_t v = 0; v < is_core.size(); ++v) is_core[v] = from_rim[v] == kFar ? 1 : 0;
  const std::vector<float> from_core =
      distances_mm(mesh, around, is_core, radius_mm + kBackReachSpacings * spacing_mm);
  keep_between(mesh, [&](std::uint32_t v) { return from_core[v] < kFar; });
}

/// Moves each vertex of a rim by a share of the way to the middle of its neighbors on the rim,
/// along the surface.
void pull(const TriangleMesh& mesh, const std::vector<std::uint32_t>& line, float share,
          std::vector<Vec3f>& rim_mm) {
  const std::vector<Vec3f> old = rim_mm;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vec3f middle =
        0.5F * (old[(k + line.size() - 1) % line.size()] + old[(k + 1) % line.size()]);
    const Vec3f& normal = mesh.vertices[line[k]].normal;
    const Vec3f step = share * (middle - old[k]);
    rim_mm[k] += step - normal * normal.dot(step);
  }
}

/// Smooths a rim without shrinking it.
/// @source  Taubin, "A signal processing approach to fair surface design", SIGGRAPH 1995.
void smooth_rim(TriangleMesh& mesh, const std::vector<std::uint32_t>& line, float most_mm) {
  constexpr float kInwards = 0.5F, kOutwards = -0.53F;
  std::vector<Vec3f> rim_mm;
  rim_mm.reserve(line.size());
  for (const std::uint32_t v : line) rim_mm.push_back(mesh.vertices[v].position_mm);
  for (int i = 0; i < kRimSmoothings; ++i) {
    pull(mesh, line, kInwards, rim_mm);
    pull(mesh, line, kOutwards, rim_mm);
  }
  for (std::size_t k = 0; k < line.size(); ++k) {
    Vec3f& place_mm = mesh.vertices[line[k]].position_mm;
    const Vec3f moved = rim_mm[k] - place_mm;
    const float length = moved.norm();
    place_mm += length > most_mm ? Vec3f(moved * (most_mm / length)) : moved;
  }
}

}  // namespace

void trim_rims(TriangleMesh& mesh, float strip_mm, float spacing_mm, const Workers& workers) {
  TriangleMesh opened = mesh;
  drop_uncrossed_rims(opened, strip_mm, workers);
  open_by_disk(opened, strip_mm, spacing_mm);
  split_fans(opened);
  drop_islands(opened, kLeastPiece * strip_mm * strip_mm);
  if (area_mm2(opened) < kLeastShare * area_mm2(mesh)) return;
  mesh = std::move(opened);
  for (const std::vector<std::uint32_t>& line : boundary_lines(mesh))
    smooth_rim(mesh, line, kMostRimMotion * spacing_mm);
}

}  // namespace flytri::meshing
