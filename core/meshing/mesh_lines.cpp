#include "core/meshing/mesh_lines.h"

#include <algorithm>
#include <utility>

#include "core/meshing/half_edges.h"

namespace flytri::meshing {
namespace {

float squared_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f along = b - a;
  const float length2 = along.squaredNorm();
  const float share = length2 > 0.0F ? std::clamp((p - a).dot(along) / length2, 0.0F, 1.0F) : 0.0F;
  return (a + share * along - p).squaredNorm();
}

/// The same triangles with places as vertices.
TriangleMesh joined_at_places(const PlaceMesh& mesh) {
  TriangleMesh joined;
  joined.vertices.resize(mesh.place_count());
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t)
    joined.triangles.push_back(mesh.is_gone(t) ? Triangle{0, 0, 0} : mesh.places_of(t));
  return joined;
}

/// Whether the triangles of a place, given by their sides that do not touch it, form one fan.
bool form_a_fan(const std::vector<std::array<std::uint32_t, 2>>& sides) {
  const auto find = [&](std::size_t end, std::uint32_t wanted) {
    return std::find_if(sides.begin(), sides.end(),
                        [&](const auto& side) { return side[end] == wanted; });
  };
  auto at = sides.begin();
  for (std::size_t i = 0; i < sides.size() && at != sides.end(); ++i) {
    const auto before = find(1, (*at)[0]);
    if (before == sides.end() || before == sides.begin()) break;
    at = before;
  }
  std::size_t count = 0;
  for (const auto start = at; at != sides.end(); ++count) {
    at = find(0, (*at)[1]);
    if (at == start) at = sides.end();
    if (count > sides.size()) break;
  }
  return count == sides.size();
}

}  // namespace

MeshLines::MeshLines(const PlaceMesh& mesh)
    : kinds_(mesh.place_count(), PlaceKind::kInner),
      lines_of_(mesh.place_count(), {PlaceMesh::kNone, PlaceMesh::kNone}) {
  find_lines(mesh);
  for (std::uint32_t place = 0; place < mesh.place_count(); ++place) fix_if_no_disk(mesh, place);
}

void MeshLines::add(std::uint32_t low, std::uint32_t high, PlaceKind kind) {
  const auto line = static_cast<std::uint32_t>(lines_.size());
  lines_.push_back({{low, high}, {}});
  for (const std::uint32_t place : {low, high}) {
    auto& [first, second] = lines_of_[place];
    const bool fits =
        kinds_[place] != PlaceKind::kFixed &&
        (first == PlaceMesh::kNone || (second == PlaceMesh::kNone && kinds_[place] == kind));
    kinds_[place] = fits ? kind : PlaceKind::kFixed;
    (first == PlaceMesh::kNone ? first : second) = line;
  }
}

void MeshLines::find_lines(const PlaceMesh& mesh) {
  const std::vector<HalfEdge> edges = half_edges_of(joined_at_places(mesh));
  const auto vertex_at = [&](const HalfEdge& edge, std::uint32_t place) {
    const Triangle& t = mesh.corners_of(edge.triangle());
    const std::uint32_t from = t[edge.corner % 3], to = t[(edge.corner % 3 + 1) % 3];
    return mesh.place_of(from) == place ? from : to;
  };
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    const HalfEdge& edge = edges[begin];
    while (end < edges.size() && edges[end].same_edge(edge)) ++end;
    if (edge.low == edge.high) continue;
    if (end - begin == 1) {
      add(edge.low, edge.high, PlaceKind::kRim);
    } else if (end - begin > 2 || edge.rising == edges[begin + 1].rising) {
      kinds_[edge.low] = kinds_[edge.high] = PlaceKind::kFixed;
    } else if (vertex_at(edge, edge.low) != vertex_at(edges[begin + 1], edge.low) ||
               vertex_at(edge, edge.high) != vertex_at(edges[begin + 1], edge.high)) {
      add(edge.low, edge.high, PlaceKind::kSeam);
    }
  }
}

/// A place moves only if its triangles form one fan, and its line runs on at both sides.
void MeshLines::fix_if_no_disk(const PlaceMesh& mesh, std::uint32_t place) {
  PlaceKind& kind = kinds_[place];
  if (kind != PlaceKind::kInner && lines_of_[place][1] == PlaceMesh::kNone)
    kind = PlaceKind::kFixed;
  if (kind == PlaceKind::kFixed) return;
  std::vector<std::array<std::uint32_t, 2>> sides;  // from, to
  for (std::uint32_t c = mesh.first_corner(place); c != PlaceMesh::kNone; c = mesh.next_corner(c)) {
    const Triangle p = mesh.places_of(c / 3);
    sides.push_back({p[(c + 1) % 3], p[(c + 2) % 3]});
  }
  if (!form_a_fan(sides)) kind = PlaceKind::kFixed;
}

std::array<std::uint32_t, 2> MeshLines::neighbors_of(std::uint32_t place) const {
  std::array<std::uint32_t, 2> neighbors{};
  for (const std::size_t i : {0, 1}) {
    const auto& ends = lines_[lines_of_[place][i]].ends;
    neighbors[i] = ends[0] == place ? ends[1] : ends[0];
  }
  return neighbors;
}

bool MeshLines::stays(const PlaceMesh& mesh, std::uint32_t from, std::uint32_t onto,
                      float limit_mm) const {
  const auto [first, second] = neighbors_of(from);
  const std::uint32_t other = first == onto ? second : first;
  if (other == onto) return false;
  const auto near = [&](std::uint32_t place) {
    return squared_to_segment(mesh.position_mm(place), mesh.position_mm(onto),
                              mesh.position_mm(other)) <= limit_mm * limit_mm;
  };
  if (!near(from)) return false;
  return std::all_of(lines_of_[from].begin(), lines_of_[from].end(), [&](std::uint32_t line) {
    return std::all_of(lines_[line].gone.begin(), lines_[line].gone.end(), near);
  });
}

void MeshLines::merge(std::uint32_t from, std::uint32_t onto) {
  auto [gone, kept] = lines_of_[from];
  const auto& ends = lines_[gone].ends;
  if (ends[0] != onto && ends[1] != onto) std::swap(gone, kept);
  LineEdge& line = lines_[kept];
  std::replace(line.ends.begin(), line.ends.end(), from, onto);
  line.gone.push_back(from);
  line.gone.insert(line.gone.end(), lines_[gone].gone.begin(), lines_[gone].gone.end());
  lines_[gone] = {};
  std::replace(lines_of_[onto].begin(), lines_of_[onto].end(), gone, kept);
}

}  // namespace flytri::meshing
