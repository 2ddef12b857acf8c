#include "core/meshing/collapsible_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/meshing/least_angle.h"

namespace flytri::meshing {
namespace {

/// A triangle may lean away from the measured normals of its corners by this cosine.
constexpr float kLeastUpright = 0.5F;

bool contains(const std::vector<std::uint32_t>& sorted, std::uint32_t value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

}  // namespace

CollapsibleMesh::CollapsibleMesh(const TriangleMesh& mesh)
    : mesh_(mesh), places_(mesh), lines_(places_), former_(mesh) {
  // A place lies in a triangle only when it is gone; the middle of each lies in it from the start.
  next_sample_.assign(places_.place_count() + places_.slot_count(), kNone);
  squared_mm2_.assign(next_sample_.size(), 0.0F);
  first_sample_.resize(places_.slot_count());
  std::iota(first_sample_.begin(), first_sample_.end(),
            static_cast<std::uint32_t>(places_.place_count()));
}

void CollapsibleMesh::targets_of(std::uint32_t place, std::vector<std::uint32_t>& targets) const {
  targets.clear();
  switch (lines_.kind(place)) {
    case PlaceKind::kFixed:
      return;
    case PlaceKind::kInner:
      return places_.neighbors_of(place, targets);
    case PlaceKind::kRim:
    case PlaceKind::kSeam:
      const auto next = lines_.neighbors_of(place);
      targets.assign(next.begin(), next.end());
  }
}

/// The link condition: whoever is a neighbor of both is a corner of a triangle at their edge.
/// @source  Dey, Edelsbrunner, Guha, Nekhayev, "Topology preserving edge contraction", 1999.
bool CollapsibleMesh::keeps_manifold(std::uint32_t from, std::uint32_t onto) const {
  const PlaceKind kind = lines_.kind(from);
  const auto common = std::count_if(ring_.begin(), ring_.end(), [&](std::uint32_t place) {
    return contains(other_ring_, place);
  });
  if (common != (kind == PlaceKind::kRim ? 1 : 2)) return false;
  if (kind != PlaceKind::kInner) {
    if (star_.size() < 2) return false;
    for (const std::uint32_t next : lines_.neighbors_of(from)) {
      if (next != onto && contains(other_ring_, next)) return false;
    }
  }
  if (star_.size() != 3 || kind == PlaceKind::kRim) return true;
  // Of a tetrahedron two triangles on top of each other would be left.
  for (std::uint32_t c = places_.first_corner(onto); c != kNone; c = places_.next_corner(c)) {
    const Triangle p = places_.places_of(c / 3);
    if (std::all_of(p.begin(), p.end(), [&](std::uint32_t place) {
          return place == onto || (place != from && contains(ring_, place));
        }))
      return false;
  }
  return true;
}

bool CollapsibleMesh::line_stays(std::uint32_t from, std::uint32_t onto,
                                 const CollapseLimits& limits) const {
  const PlaceKind kind = lines_.kind(from);
  return kind == PlaceKind::kInner ||
         lines_.stays(places_, from, onto,
                      kind == PlaceKind::kRim ? limits.max_mm : limits.max_seam_mm);
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
    const NewTriangle old = made(t, places_.corners_of(t));
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
  if (sample < places_.place_count()) return places_.position_mm(sample);
  const Triangle& t = mesh_.triangles[sample - places_.place_count()];
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

/// Lists what a step onto a place adds. Edges that were there have been checked when they came.
void CollapsibleMesh::list_new_middles(std::uint32_t onto) {
  new_middles_mm_.clear();
  const Vec3f& center_mm = places_.position_mm(onto);
  for (const NewTriangle& t : new_) {
    new_middles_mm_.push_back((t.a + t.b + t.c) / 3.0F);
    for (const std::uint32_t vertex : t.corners) {
      const std::uint32_t place = places_.place_of(vertex);
      if (place == onto || contains(other_ring_, place)) continue;
      const Vec3f middle_mm = 0.5F * (center_mm + places_.position_mm(place));
      // Two of the triangles have the same edge.
      const auto end = new_middles_mm_.end();
      if (std::find(new_middles_mm_.begin(), end, middle_mm) == end)
        new_middles_mm_.push_back(middle_mm);
    }
  }
}

bool CollapsibleMesh::is_near_former(float max_mm) const {
  return std::all_of(new_middles_mm_.begin(), new_middles_mm_.end(), [&](const Vec3f& p) {
    return former_.is_within(p, static_cast<double>(max_mm));
  });
}

/// Puts the new triangles into the place of the star's.
void CollapsibleMesh::replace_star() {
  for (const std::uint32_t t : star_) {
    places_.remove(t);
    first_sample_[t] = kNone;
  }
  for (const NewTriangle& t : new_) places_.put(t.slot, t.corners);
  for (const Assignment& now : assigned_) {
    squares_mm2_ += static_cast<double>(now.squared_mm2) -
                    static_cast<double>(std::exchange(squared_mm2_[now.sample], now.squared_mm2));
    next_sample_[now.sample] = std::exchange(first_sample_[now.slot], now.sample);
  }
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
    const Triangle p = places_.places_of(t);
    return static_cast<std::size_t>(std::find(p.begin(), p.end(), place) - p.begin());
  };
  for (const std::uint32_t t : star_) {
    const std::size_t k = corner_at(t, onto);
    if (k == 3) continue;
    const Triangle& corners = places_.corners_of(t);
    const std::uint32_t vertex = corners[corner_at(t, from)], next = corners[k];
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
    Triangle corners = places_.corners_of(t);
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
  places_.triangles_of(from, star_);
  places_.neighbors_of(from, ring_);
  places_.neighbors_of(onto, other_ring_);
  if (!keeps_manifold(from, onto) || !prepare(from, onto) || !are_good(limits) ||
      !line_stays(from, onto, limits))
    return false;
  assigned_.clear();
  if (!assign(from, limits.max_mm) || !assign_star(limits.max_mm)) return false;
  list_new_middles(onto);
  if (!is_near_former(limits.max_mm)) return false;
  replace_star();
  if (lines_.kind(from) != PlaceKind::kInner) lines_.merge(from, onto);
  return true;
}

bool CollapsibleMesh::flip(std::uint32_t triangle, const CollapseLimits& limits) {
  const Triangle corners = places_.corners_of(triangle);
  const NewTriangle old = made(triangle, corners);
  const std::array<float, 3> sides = {(old.b - old.a).squaredNorm(), (old.c - old.b).squaredNorm(),
                                      (old.a - old.c).squaredNorm()};
  const auto k =
      static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
  // The other triangle at the longest side, with the same vertices there: no seam.
  for (std::uint32_t at = places_.first_corner(places_.place_of(b)); at != kNone;
       at = places_.next_corner(at)) {
    const Triangle& other = places_.corners_of(at / 3);
    if (other[at % 3] != b || other[(at + 1) % 3] != a) continue;
    const std::uint32_t d = other[(at + 2) % 3];
    const std::uint32_t place_c = places_.place_of(c), place_d = places_.place_of(d);
    places_.neighbors_of(place_c, ring_);
    if (contains(ring_, place_d) || place_c == place_d) return false;
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
    new_middles_mm_ = {(new_[0].a + new_[0].b + new_[0].c) / 3.0F,
                       (new_[1].a + new_[1].b + new_[1].c) / 3.0F,
                       0.5F * (places_.position_mm(place_c) + places_.position_mm(place_d))};
    if (!assign_star(limits.max_mm) || !is_near_former(limits.max_mm)) return false;
    replace_star();
    return true;
  }
  return false;
}

bool CollapsibleMesh::is_thin(std::uint32_t triangle, const CollapseLimits& limits) const {
  const NewTriangle t = made(triangle, places_.corners_of(triangle));
  return sine_of_least_angle(t.a, t.b, t.c) < std::sin(limits.least_angle_rad) || upright(t) < 0.0F;
}

double CollapsibleMesh::max_mm() const {
  return std::sqrt(
      static_cast<double>(*std::max_element(squared_mm2_.begin(), squared_mm2_.end())));
}

}  // namespace flytri::meshing
