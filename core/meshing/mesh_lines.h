/// @file  The rims and the seams of a mesh, which stay lines of edges while places are taken away.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/meshing/place_mesh.h"

namespace flytri::meshing {

/// How a place may move.
enum class PlaceKind : char {
  kInner,  ///< onto any neighbor
  kRim,    ///< along the rim
  kSeam,   ///< along the seam of the texture
  kFixed   ///< not at all: a line ends or branches there, or its triangles form no disk
};

/// The kind of each place, and the lines along rims and seams.
class MeshLines {
 public:
  explicit MeshLines(const PlaceMesh& mesh);

  [[nodiscard]] PlaceKind kind(std::uint32_t place) const { return kinds_[place]; }
  /// The next places along the line of a place on a rim or a seam.
  [[nodiscard]] std::array<std::uint32_t, 2> neighbors_of(std::uint32_t place) const;
  /// Whether all places that the line has lost stay within the limit of it, if one moves on.
  [[nodiscard]] bool stays(const PlaceMesh& mesh, std::uint32_t from, std::uint32_t onto,
                           float limit_mm) const;
  /// One place of a line has moved onto the next.
  void merge(std::uint32_t from, std::uint32_t onto);

 private:
  /// An edge of a line, with the places that it replaces.
  struct LineEdge {
    std::array<std::uint32_t, 2> ends = {PlaceMesh::kNone, PlaceMesh::kNone};
    std::vector<std::uint32_t> gone;
  };
  void add(std::uint32_t low, std::uint32_t high, PlaceKind kind);
  void find_lines(const PlaceMesh& mesh);
  void fix_if_no_disk(const PlaceMesh& mesh, std::uint32_t place);

  std::vector<PlaceKind> kinds_;
  std::vector<LineEdge> lines_;
  std::vector<std::array<std::uint32_t, 2>> lines_of_;  ///< the two line edges at a place
};

}  // namespace flytri::meshing
