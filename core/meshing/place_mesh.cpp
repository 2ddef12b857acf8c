#include "core/meshing/place_mesh.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

namespace flytri::meshing {

PlaceMesh::PlaceMesh(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
  join_places(mesh);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const Triangle p = places_of(t);
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) triangles_[t] = {kNone, kNone, kNone};
  }
  first_corner_.assign(place_count(), kNone);
  next_corner_.assign(3 * triangles_.size(), kNone);
  // From the last, so that the lists rise.
  for (std::uint32_t corner = static_cast<std::uint32_t>(next_corner_.size()); corner-- > 0;)
    if (!is_gone(corner / 3)) link_corner(corner);
}

void PlaceMesh::join_places(const TriangleMesh& mesh) {
  const auto key = [&](std::uint32_t v) {
    const Vec3f& p = mesh.vertices[v].position_mm;
    return std::tuple(p.x(), p.y(), p.z(), v);
  };
  const auto same = [&](std::uint32_t v, std::uint32_t w) {
    return mesh.vertices[v].position_mm == mesh.vertices[w].position_mm;
  };
  std::vector<std::uint32_t> order(mesh.vertices.size());
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
      position_mm_.push_back(mesh.vertices[v].position_mm);
    } else {
      place_of_[v] = place_of_[place_of_[v]];
    }
  }
}

Triangle PlaceMesh::places_of(std::uint32_t slot) const {
  const Triangle& t = triangles_[slot];
  return {place_of_[t[0]], place_of_[t[1]], place_of_[t[2]]};
}

std::vector<Triangle> PlaceMesh::triangles() const {
  std::vector<Triangle> left;
  std::copy_if(triangles_.begin(), triangles_.end(), std::back_inserter(left),
               [](const Triangle& t) { return t[0] != kNone; });
  return left;
}

void PlaceMesh::triangles_of(std::uint32_t place, std::vector<std::uint32_t>& slots) const {
  slots.clear();
  for (std::uint32_t c = first_corner_[place]; c != kNone; c = next_corner_[c])
    slots.push_back(c / 3);
}

void PlaceMesh::neighbors_of(std::uint32_t place, std::vector<std::uint32_t>& neighbors) const {
  neighbors.clear();
  for (std::uint32_t c = first_corner_[place]; c != kNone; c = next_corner_[c]) {
    const Triangle& t = triangles_[c / 3];
    neighbors.push_back(place_of_[t[(c + 1) % 3]]);
    neighbors.push_back(place_of_[t[(c + 2) % 3]]);
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
}

void PlaceMesh::link_corner(std::uint32_t corner) {
  std::uint32_t& first = first_corner_[place_of_[triangles_[corner / 3][corner % 3]]];
  next_corner_[corner] = first;
  first = corner;
}

void PlaceMesh::remove(std::uint32_t slot) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t corner = 3 * slot + k;
    std::uint32_t* link = &first_corner_[place_of_[triangles_[slot][k]]];
    while (*link != corner) link = &next_corner_[*link];
    *link = next_corner_[corner];
  }
  triangles_[slot] = {kNone, kNone, kNone};
}

void PlaceMesh::put(std::uint32_t slot, const Triangle& corners) {
  triangles_[slot] = corners;
  for (std::uint32_t k = 0; k < 3; ++k) link_corner(3 * slot + k);
}

}  // namespace flytri::meshing
