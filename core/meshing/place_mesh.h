/// @file  The triangles of a mesh by places: vertices at exactly the same position are one place.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// Triangles that can be replaced, with lists of those around each place. Where vertices of one
/// place differ, a seam of the texture runs.
class PlaceMesh {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Triangles with two corners at one place have no area, and are gone from the start.
  explicit PlaceMesh(const TriangleMesh& mesh);

  [[nodiscard]] std::size_t place_count() const { return position_mm_.size(); }
  [[nodiscard]] const Vec3f& position_mm(std::uint32_t place) const { return position_mm_[place]; }
  [[nodiscard]] std::uint32_t place_of(std::uint32_t vertex) const { return place_of_[vertex]; }

  /// Number of triangles, with those that are gone.
  [[nodiscard]] std::size_t slot_count() const { return triangles_.size(); }
  [[nodiscard]] bool is_gone(std::uint32_t slot) const { return triangles_[slot][0] == kNone; }
  /// The vertices of a triangle.
  [[nodiscard]] const Triangle& corners_of(std::uint32_t slot) const { return triangles_[slot]; }
  [[nodiscard]] Triangle places_of(std::uint32_t slot) const;
  /// The triangles that are left.
  [[nodiscard]] std::vector<Triangle> triangles() const;

  /// The corners at a place, as 3 slot + k; kNone ends the list.
  [[nodiscard]] std::uint32_t first_corner(std::uint32_t place) const {
    return first_corner_[place];
  }
  [[nodiscard]] std::uint32_t next_corner(std::uint32_t corner) const {
    return next_corner_[corner];
  }
  /// The triangles around a place.
  void triangles_of(std::uint32_t place, std::vector<std::uint32_t>& slots) const;
  /// The places around a place, rising.
  void neighbors_of(std::uint32_t place, std::vector<std::uint32_t>& neighbors) const;

  void remove(std::uint32_t slot);
  /// @param slot  of a triangle that is gone
  void put(std::uint32_t slot, const Triangle& corners);

 private:
  void join_places(const TriangleMesh& mesh);
  void link_corner(std::uint32_t corner);

  std::vector<std::uint32_t> place_of_;
  std::vector<Vec3f> position_mm_;
  std::vector<Triangle> triangles_;  ///< of vertices of the mesh; gone: kNone
  std::vector<std::uint32_t> first_corner_, next_corner_;
};

}  // namespace flytri::meshing
