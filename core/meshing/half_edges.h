/// @file  The directed edges of a mesh's triangles, sorted so that half-edges of the same edge are
///          neighbors.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// A directed edge of a triangle.
struct HalfEdge {
  std::uint32_t low, high;  ///< its vertex indices, low <= high
  std::uint32_t corner;     ///< 3 t + k: starts at corner k of triangle t
  bool rising;              ///< directed from low to high

  [[nodiscard]] std::uint32_t triangle() const { return corner / 3; }
  [[nodiscard]] bool same_edge(const HalfEdge& other) const {
    return low == other.low && high == other.high;
  }
};

/// All half-edges, sorted by low, then high, then corner.
/// @param mesh  indices valid
[[nodiscard]] std::vector<HalfEdge> half_edges_of(const TriangleMesh& mesh);

}  // namespace flytri::meshing
