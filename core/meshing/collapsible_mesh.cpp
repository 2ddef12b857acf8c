#include "core/meshing/collapsible_mesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/meshing/half_edges.h"
#include "core/meshing/least_angle.h"

namespace flytri::meshing {
namespace {

/// A triangle may lean away from the measured normals of its corners by this cosine.
constexpr float kLeastUpright = 0.5F;

float squared_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f along = b - a;
  const float length2 = along.squaredNorm();
  const float share = length2 > 0.0F ? std::clamp((p - a).dot(along) / length2, 0.0F, 1.0F) : 0.0F;
  return (a + share * along - p).squaredNorm();
}

bool contains(const std::vector<std::uint32_t>& sorted, std::uint32_t value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

}  // namespace

CollapsibleMesh::CollapsibleMesh(const TriangleMesh& mesh)
    : mesh_(mesh), triangles_(mesh.triangles), former_(mesh) {
  join_places();
  // Without area from the start: two corners at one place.
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const Triangle p = places_of(t);
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) triangles_[t] = {kNone, kNone, kNone};
  }
  first_corner_.assign(place_count(), kNone);
  next_corner_.assign(3 * triangles_.size(), kNone);
  // From the last, so that the lists rise.
  for (std::uint32_t corner = static_cast<std::uint32_t>(next_corner_.size()); corner-- > 0;)
    if (!is_gone(corner / 3)) link_corner(corner);
  // A place lies in a triangle only when it is gone; the middle of each lies in it from the start.
  next_sample_.assign(place_count() + triangles_.size(), kNone);
  squared_mm2_.assign(next_sample_.size(), 0.0F);
  first_sample_.resize(triangles_.size());
  std::iota(first_sample_.begin(), first_sample_.end(), static_cast<std::uint32_t>(place_count()));
  classify_edges();
}

void CollapsibleMesh::join_places() {
  const auto key = [&](std::uint32_t v) {
    const Vec3f& p = mesh_.vertices[v].position_mm;
    return std::tuple(p.x(), p.y(), p.z(), v);
  };
  const auto same = [&](std::uint32_t v, std::uint32_t w) {
    return mesh_.vertices[v].position_mm == mesh_.vertices[w].position_mm;
  };
  std::vector<std::uint32_t> order(mesh_.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t v, std::uint32_t w) { return key(v) < key(w); });
  place_of_.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || !same(order[i - 1], order[i]);
    place_of_[order[i]] = is_new ? order[i] : place_of_[order[i - 1]];
  }
  // The first vertex of each place stands for it; places get numbers in this order.
  for (std::uint32_t v = 0; v < place_of_.size(); ++v) {
    if (place_of_[v] == v) {
      place_of_[v] = static_cast<std::uint32_t>(position_mm_.size());
      position_mm_.push_back(mesh_.vertices[v].position_mm);
    } else {
      place_of_[v] = place_of_[place_of_[v]];
    }
  }
}

void CollapsibleMesh::classify_edges() {
  TriangleMesh joined;
  joined.vertices.resize(place_count());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    joined.triangles.push_back(is_gone(t) ? Triangle{0, 0, 0} : places_of(t));
  const std::vector<HalfEdge> edges = half_edges_of(joined);
  kind_.assign(place_count(), Kind::kInner);
  lines_of_.assign(place_count(), {kNone, kNone});
  const auto vertex_at = [&](const HalfEdge& edge, std::uint32_t place) {
    const Triangle& t = triangles_[edge.triangle()];
    const std::uint32_t from = t[edge.corner % 3], to = t[(edge.corner % 3 + 1) % 3];
    return place_of_[from] == place ? from : to;
  };
  const auto add_line = [&](const HalfEdge& edge, Kind kind) {
    const auto line = static_cast<std::uint32_t>(lines_.size());
    lines_.push_back({{edge.low, edge.high}, {}});
    for (const std::uint32_t place : {edge.low, edge.high}) {
      auto& [first, second] = lines_of_[place];
      const bool fits = kind_[place] != Kind::kFixed &&
                        (first == kNone || (second == kNone && kind_[place] == kind));
      kind_[place] = fits ? kind : Kind::kFixed;
      (first == kNone ? first : second) = line;
    }
  };
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    const HalfEdge& edge = edges[begin];
    while (end < edges.size() && edges[end].same_edge(edge)) ++end;
    if (edge.low == edge.high) continue;
    if (end - begin == 1) {
      add_line(edge, Kind::kRim);
    } else if (end - begin > 2 || edge.rising == edges[begin + 1].rising) {
      kind_[edge.low] = kind_[edge.high] = Kind::kFixed;
    } else if (vertex_at(edge, edge.low) != vertex_at(edges[begin + 1], edge.low) ||
               vertex_at(edge, edge.high) != vertex_at(edges[begin + 1], edge.high)) {
      add_line(edge, Kind::kSeam);
    }
  }
  for (std::uint32_t place = 0; place < place_count(); ++place) fix_if_no_disk(place);
}

/// A place moves only if its triangles form one fan, and its line runs on at both sides.
void CollapsibleMesh::fix_if_no_disk(std::uint32_t place) {
  if (kind_[place] != Kind::kInner && lines_of_[place][1] == kNone) kind_[place] = Kind::kFixed;
  if (kind_[place] == Kind::kFixed) return;
  triangles_of(place, star_);
  std::vector<std::array<std::uint32_t, 2>> sides;  // of each triangle: from, to
  for (const std::uint32_t t : star_) {
    const Triangle p = places_of(t);
    const std::size_t k = p[0] == place ? 0 : p[1] == place ? 1 : 2;
    sides.push_back({p[(k + 1) % 3], p[(k + 2) % 3]});
  }
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
  if (count != sides.size()) kind_[place] = Kind::kFixed;
}

Triangle CollapsibleMesh::places_of(std::uint32_t triangle) const {
  const Triangle& t = triangles_[triangle];
  return {place_of_[t[0]], place_of_[t[1]], place_of_[t[2]]};
}

void CollapsibleMesh::link_corner(std::uint32_t corner) {
  std::uint32_t& first = first_corner_[place_of_[triangles_[corner / 3][corner % 3]]];
  next_corner_[corner] = first;
  first = corner;
}

void CollapsibleMesh::unlink_corners(std::uint32_t triangle) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t corner = 3 * triangle + k;
    std::uint32_t* link = &first_corner_[place_of_[triangles_[triangle][k]]];
    while (*link != corner) link = &next_corner_[*link];
    *link = next_corner_[corner];
  }
}

void CollapsibleMesh::triangles_of(std::uint32_t place,
                                   std::vector<std::uint32_t>& triangles) const {
  triangles.clear();
  for (std::uint32_t c = first_corner_[place]; c != kNone; c = next_corner_[c])
    triangles.push_back(c / 3);
}

void CollapsibleMesh::neighbors_of(std::uint32_t place,
                                   std::vector<std::uint32_t>& neighbors) const {
  neighbors.clear();
  for (std::uint32_t c = first_corner_[place]; c != kNone; c = next_corner_[c]) {
    const Triangle& t = triangles_[c / 3];
    neighbors.push_back(place_of_[t[(c + 1) % 3]]);
    neighbors.push_back(place_of_[t[(c + 2) % 3]]);
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
}

void CollapsibleMesh::targets_of(std::uint32_t place, std::vector<std::uint32_t>& targets) const {
  targets.clear();
  if (kind_[place] == Kind::kFixed) return;
  if (kind_[place] == Kind::kInner) return neighbors_of(place, targets);
  for (const std::uint32_t line : lines_of_[place]) {
    const auto& ends = lines_[line].ends;
    targets.push_back(ends[0] == place ? ends[1] : ends[0]);
  }
}

/// The link condition: whoever is a neighbor of both is a corner of a triangle at their edge.
/// @source  Dey, Edelsbrunner, Guha, Nekhayev, "Topology preserving edge contraction", 1999.
bool CollapsibleMesh::keeps_manifold(std::uint32_t from, std::uint32_t onto) const {
  const auto common = std::count_if(ring_.begin(), ring_.end(), [&](std::uint32_t place) {
    return contains(other_ring_, place);
  });
  if (common != (kind_[from] == Kind::kRim ? 1 : 2)) return false;
  if (kind_[from] != Kind::kInner) {
    if (star_.size() < 2) return false;
    for (const std::uint32_t line : lines_of_[from]) {
      for (const std::uint32_t end : lines_[line].ends) {
        if (end != from && end != onto && contains(other_ring_, end)) return false;
      }
    }
  }
  if (star_.size() != 3 || kind_[from] == Kind::kRim) return true;
  // Of a tetrahedron two triangles on top of each other would be left.
  for (std::uint32_t c = first_corner_[onto]; c != kNone; c = next_corner_[c]) {
    const Triangle p = places_of(c / 3);
    if (std::all_of(p.begin(), p.end(), [&](std::uint32_t place) {
          return place == onto || (place != from && contains(ring_, place));
        }))
      return false;
  }
  return true;
}

bool CollapsibleMesh::line_stays(std::uint32_t from, std::uint32_t onto,
                                 const CollapseLimits& limits) const {
  if (kind_[from] == Kind::kInner) return true;
  const float limit_mm = kind_[from] == Kind::kRim ? limits.max_mm : limits.max_seam_mm;
  std::uint32_t other = kNone;
  for (const std::uint32_t line : lines_of_[from]) {
    for (const std::uint32_t end : lines_[line].ends) {
      if (end != from && end != onto) other = end;
    }
  }
  if (other == kNone) return false;
  const auto near = [&](std::uint32_t place) {
    return squared_to_segment(position_mm_[place], position_mm_[onto], position_mm_[other]) <=
           limit_mm * limit_mm;
  };
  if (!near(from)) return false;
  return std::all_of(lines_of_[from].begin(), lines_of_[from].end(), [&](std::uint32_t line) {
    return std::all_of(lines_[line].gone.begin(), lines_[line].gone.end(), near);
  });
}

CollapsibleMesh::NewTriangle CollapsibleMesh::made(std::uint32_t slot,
                                                   const Triangle& corners) const {
  return {slot, corners, mesh_.vertices[corners[0]].position_mm,
          mesh_.vertices[corners[1]].position_mm, mesh_.vertices[corners[2]].position_mm};
}

/// Cosine between a triangle and the measured normals of its corners.
float CollapsibleMesh::upright(const NewTriangle& t) const {
  const Vec3f area = (t.b - t.a).cross(t.c - t.a);
  const Vec3f normal = mesh_.vertices[t.corners[0]].normal + mesh_.vertices[t.corners[1]].normal +
                       mesh_.vertices[t.corners[2]].normal;
  const float size = area.norm() * normal.norm();
  return size > 0.0F ? area.dot(normal) / size : -1.0F;
}

/// No worse than what it replaces, or good enough.
bool CollapsibleMesh::are_good(const CollapseLimits& limits) const {
  float upright_before = 1.0F, sine_before = 1.0F;
  for (const std::uint32_t t : star_) {
    const NewTriangle old = made(t, triangles_[t]);
    upright_before = std::min(upright_before, upright(old));
    sine_before = std::min(sine_before, sine_of_least_angle(old.a, old.b, old.c));
  }
  const float least_upright = std::min(kLeastUpright, upright_before);
  const float least = std::min(std::sin(limits.least_angle_rad), sine_before);
  return std::all_of(new_.begin(), new_.end(), [&](const NewTriangle& t) {
    return sine_of_least_angle(t.a, t.b, t.c) >= least && upright(t) >= least_upright;
  });
}

Vec3f CollapsibleMesh::sample_mm(std::uint32_t sample) const {
  if (sample < place_count()) return position_mm_[sample];
  const Triangle& t = mesh_.triangles[sample - place_count()];
  return (mesh_.vertices[t[0]].position_mm + mesh_.vertices[t[1]].position_mm +
          mesh_.vertices[t[2]].position_mm) /
         3.0F;
}

bool CollapsibleMesh::assign(std::uint32_t sample, float max_mm) {
  Assignment best{sample, kNone, max_mm * max_mm};
  const Vec3f p = sample_mm(sample);
  for (const NewTriangle& t : new_) {
    const float squared = (closest_on_triangle(p, t.a, t.b, t.c) - p).squaredNorm();
    if (squared <= best.squared_mm2) best = {sample, t.slot, squared};
  }
  if (best.slot == kNone) return false;
  assigned_.push_back(best);
  return true;
}

/// Assigns all that was assigned to the triangles of the star.
bool CollapsibleMesh::assign_star(float max_mm) {
  for (const std::uint32_t t : star_) {
    for (std::uint32_t s = first_sample_[t]; s != kNone; s = next_sample_[s]) {
      if (!assign(s, max_mm)) return false;
    }
  }
  return true;
}

/// The middles of the new triangles and of their edges.
bool CollapsibleMesh::is_near_former(float max_mm) const {
  const auto near = [&](const Vec3f& p) {
    return former_.closest(p, static_cast<double>(max_mm)).distance_mm <=
           static_cast<double>(max_mm);
  };
  return std::all_of(new_.begin(), new_.end(), [&](const NewTriangle& t) {
    return near((t.a + t.b + t.c) / 3.0F) && near(0.5F * (t.a + t.b)) && near(0.5F * (t.b + t.c)) &&
           near(0.5F * (t.c + t.a));
  });
}

/// Puts the new triangles into the place of the star's.
void CollapsibleMesh::replace_star() {
  for (const std::uint32_t t : star_) {
    unlink_corners(t);
    triangles_[t] = {kNone, kNone, kNone};
    first_sample_[t] = kNone;
  }
  for (const NewTriangle& t : new_) {
    triangles_[t.slot] = t.corners;
    for (std::uint32_t k = 0; k < 3; ++k) link_corner(3 * t.slot + k);
  }
  for (const Assignment& now : assigned_) {
    squares_mm2_ += static_cast<double>(now.squared_mm2) -
                    static_cast<double>(std::exchange(squared_mm2_[now.sample], now.squared_mm2));
    next_sample_[now.sample] = std::exchange(first_sample_[now.slot], now.sample);
  }
}

void CollapsibleMesh::merge_lines(std::uint32_t from, std::uint32_t onto) {
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

/// Makes the new triangles of a step.
bool CollapsibleMesh::prepare(std::uint32_t from, std::uint32_t onto) {
  // What becomes of each vertex at the place: across a seam there are two.
  std::vector<std::pair<std::uint32_t, std::uint32_t>>& becomes = becomes_;
  becomes.clear();
  const auto find = [&](std::uint32_t vertex) {
    return std::find_if(becomes.begin(), becomes.end(),
                        [&](const auto& pair) { return pair.first == vertex; });
  };
  const auto corner_at = [&](std::uint32_t t, std::uint32_t place) {
    const Triangle p = places_of(t);
    return static_cast<std::size_t>(std::find(p.begin(), p.end(), place) - p.begin());
  };
  for (const std::uint32_t t : star_) {
    const std::size_t k = corner_at(t, onto);
    if (k == 3) continue;
    const std::uint32_t vertex = triangles_[t][corner_at(t, from)], next = triangles_[t][k];
    const auto known = find(vertex);
    if (known == becomes.end()) {
      becomes.emplace_back(vertex, next);
    } else if (known->second != next) {
      return false;
    }
  }
  new_.clear();
  for (const std::uint32_t t : star_) {
    if (corner_at(t, onto) != 3) continue;
    Triangle corners = triangles_[t];
    std::uint32_t& moved = corners[corner_at(t, from)];
    const auto known = find(moved);
    if (known == becomes.end()) return false;
    moved = known->second;
    new_.push_back(made(t, corners));
  }
  return !new_.empty();
}

bool CollapsibleMesh::collapse(std::uint32_t from, std::uint32_t onto,
                               const CollapseLimits& limits) {
  triangles_of(from, star_);
  neighbors_of(from, ring_);
  neighbors_of(onto, other_ring_);
  if (!keeps_manifold(from, onto) || !prepare(from, onto) || !are_good(limits) ||
      !line_stays(from, onto, limits))
    return false;
  assigned_.clear();
  if (!assign(from, limits.max_mm) || !assign_star(limits.max_mm) || !is_near_former(limits.max_mm))
    return false;
  replace_star();
  if (kind_[from] != Kind::kInner) merge_lines(from, onto);
  return true;
}

bool CollapsibleMesh::flip(std::uint32_t triangle, const CollapseLimits& limits) {
  const Triangle corners = triangles_[triangle];
  const NewTriangle old = made(triangle, corners);
  const std::array<float, 3> sides = {(old.b - old.a).squaredNorm(), (old.c - old.b).squaredNorm(),
                                      (old.a - old.c).squaredNorm()};
  const auto k =
      static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
  // The other triangle at the longest side, with the same vertices there: no seam.
  for (std::uint32_t at = first_corner_[place_of_[b]]; at != kNone; at = next_corner_[at]) {
    const Triangle& other = triangles_[at / 3];
    if (other[at % 3] != b || other[(at + 1) % 3] != a) continue;
    const std::uint32_t d = other[(at + 2) % 3];
    neighbors_of(place_of_[c], ring_);
    if (contains(ring_, place_of_[d]) || place_of_[c] == place_of_[d]) return false;
    star_ = {triangle, at / 3};
    new_ = {made(star_[0], {a, d, c}), made(star_[1], {d, b, c})};
    const NewTriangle beyond = made(star_[1], other);
    const float before = std::min(sine_of_least_angle(old.a, old.b, old.c),
                                  sine_of_least_angle(beyond.a, beyond.b, beyond.c));
    const auto is_better = [&](const NewTriangle& t) {
      return sine_of_least_angle(t.a, t.b, t.c) > before && upright(t) >= kLeastUpright;
    };
    if (!std::all_of(new_.begin(), new_.end(), is_better)) return false;
    assigned_.clear();
    if (!assign_star(limits.max_mm) || !is_near_former(limits.max_mm)) return false;
    replace_star();
    return true;
  }
  return false;
}

bool CollapsibleMesh::is_thin(std::uint32_t triangle, const CollapseLimits& limits) const {
  const NewTriangle t = made(triangle, triangles_[triangle]);
  return sine_of_least_angle(t.a, t.b, t.c) < std::sin(limits.least_angle_rad) || upright(t) < 0.0F;
}

std::vector<Triangle> CollapsibleMesh::triangles() const {
  std::vector<Triangle> left;
  std::copy_if(triangles_.begin(), triangles_.end(), std::back_inserter(left),
               [](const Triangle& t) { return t[0] != kNone; });
  return left;
}

double CollapsibleMesh::max_mm() const {
  return std::sqrt(
      static_cast<double>(*std::max_element(squared_mm2_.begin(), squared_mm2_.end())));
}

}  // namespace flytri::meshing
