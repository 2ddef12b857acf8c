/// @file  A few clicks near an edge -> a closed path of mesh edges that follows it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::review {

struct EdgePathOptions {
  /// Default 0.25, > 0. Normals within this distance of a vertex tell how the surface bends there,
  /// mm: the width of an edge as it is scanned.
  double bending_mm = 0.25;
  /// Default 0.5, > 0. A click goes to the sharpest vertex within this distance, mm.
  double snap_mm = 0.5;
  /// Default 0.7, > 0. Less bending is no edge, 1/mm: about 20 degrees over twice `bending_mm`.
  double least_bending_per_mm = 0.7;
  /// Default 0.03, (0, 1]. Cost of a step along the sharpest edge by that over a flat surface.
  double edge_cost = 0.03;

  [[nodiscard]] Result<void> validate() const;
};

/// The vertices of the path, in order, each once. From each click to the next, and from the last
/// to the first, it is the path of least cost: its length, larger where the surface bends less.
/// @param mesh  welded, with unit normals
/// @param clicks_mm  three or more, in order along the edge
/// @source  Dijkstra, "A note on two problems in connexion with graphs", 1959.
/// @errors  kBadOption: fewer than three clicks; kInsufficient: no edge near a click;
///          kInconsistent: no way from a click to the next, or it comes back on itself.
[[nodiscard]] Result<std::vector<std::uint32_t>> edge_path(const TriangleMesh& mesh,
                                                           std::span<const Vec3> clicks_mm,
                                                           const EdgePathOptions& options);

}  // namespace flytri::review
