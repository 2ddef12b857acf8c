/// @file  The surface that closes one hole. Only for close_holes.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// Corners 0 to rim - 1 are those of the hole's rim, in order; the others lie inside.
struct HolePatch {
  std::vector<Vec3> corners_mm;
  std::vector<Triangle> triangles;
};

/// The triangles of least area between the corners of a rim.
/// @param rim_mm     at least three, counter-clockwise seen from outside
/// @param is_edge    whether two corners of the rim are joined by an edge outside of the hole,
///                   which no triangle may have again; size of the rim squared
/// @returns nullopt if there are none
[[nodiscard]] std::optional<HolePatch> least_area_patch(const std::vector<Vec3>& rim_mm,
                                                        const std::vector<char>& is_edge);

/// Adds corners inside until the edges are as long as those of the rim.
/// @param is_edge  as for least_area_patch
void refine_patch(HolePatch& patch, const std::vector<char>& is_edge, std::size_t rim_count);

/// The neighbors of the rim outside of the patch, for a corner of the rim: positions.
using OuterNeighbors = std::vector<std::vector<Vec3>>;

/// Moves the inner corners so that the surface bends as little as it can, going on from what is
/// around the hole.
/// @param outer  of each corner of the rim
void fair_patch(HolePatch& patch, const OuterNeighbors& outer);

}  // namespace flytri::meshing
