/// @file  Surface nets: from the values of a function at the corners of a grid to the net of its
/// zero surface, one vertex in each cell that the surface crosses.
///
/// @source  Gibson, "Constrained elastic surface nets", MICCAI 1998.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry/cell_key.h"

namespace flytri {

/// A corner of the grid, or the cell whose lowest corner it is. Corners sort by z, then y, then x:
/// what is next along x is next in a sorted list.
[[nodiscard]] constexpr CellKey grid_key(std::int32_t x, std::int32_t y, std::int32_t z) {
  return {z, y, x};
}
[[nodiscard]] constexpr std::int32_t grid_number(CellKey key, int axis) { return key[2 - axis]; }
[[nodiscard]] constexpr CellKey grid_step(CellKey key, int axis, std::int32_t steps) {
  return key.moved(2 - axis, steps);
}

/// Corner k of a cell, 0..7, lies at (k & 1, k >> 1 & 1, k >> 2).
[[nodiscard]] constexpr CellKey corner_of(CellKey cell, int k) {
  return grid_step(grid_step(grid_step(cell, 0, k & 1), 1, k >> 1 & 1), 2, k >> 2);
}

/// Looks up rising keys in a sorted list: each search begins where the last one ended, so that
/// near ones cost little.
class KeyCursor {
 public:
  static constexpr std::uint32_t kNotThere = std::numeric_limits<std::uint32_t>::max();

  /// @param keys  sorted; kept by reference
  explicit KeyCursor(const std::vector<CellKey>& keys) : keys_(keys) {}

  /// Position of the key in the list, or kNotThere.
  [[nodiscard]] std::uint32_t find(CellKey key);

 private:
  const std::vector<CellKey>& keys_;
  std::size_t at_ = 0;
};

/// What a function has at some corners of a grid: negative inside, NaN where it is not known.
struct CornerValues {
  std::vector<CellKey> corners;  ///< sorted
  std::vector<float> values;     ///< of the same corners
};

/// Reads the values at the corners of rising cells.
class CornerReader {
 public:
  /// @param grid  kept by reference
  explicit CornerReader(const CornerValues& grid)
      : rows_{KeyCursor(grid.corners), KeyCursor(grid.corners), KeyCursor(grid.corners),
              KeyCursor(grid.corners)},
        grid_(grid) {}

  /// By corner of the cell, see corner_of. NaN where the grid has no such corner.
  [[nodiscard]] std::array<float, 8> around(CellKey cell);

 private:
  std::array<KeyCursor, 4> rows_;  ///< along x, by y and z
  const CornerValues& grid_;
};

/// True if all corners are known and lie on both sides of the surface.
[[nodiscard]] bool is_crossed(const std::array<float, 8>& values);

/// Calls visit(k, l, share) for each edge of a crossed cell that the surface crosses: from corner k
/// to corner l, one step up an axis, at this share of the way. A vertex is the mean of these.
template <typename Visit>
void for_each_crossing(const std::array<float, 8>& values, const Visit& visit) {
  for (int k = 0; k < 8; ++k) {
    for (int bit = 1; bit < 8; bit <<= 1) {
      const int l = k | bit;
      if (l == k || (values[k] < 0.0F) == (values[l] < 0.0F)) continue;
      visit(k, l, static_cast<double>(values[k]) / static_cast<double>(values[k] - values[l]));
    }
  }
}

/// Finds the quadrilaterals of a net: one across each crossed edge whose four cells have a vertex.
class NetEdges {
 public:
  /// @param cells  that have a vertex; sorted. Both are kept by reference.
  NetEdges(const CornerValues& grid, const std::vector<CellKey>& cells)
      : grid_(grid), ends_(3, KeyCursor(grid.corners)), around_(12, KeyCursor(cells)) {}

  /// Calls visit(ring) for each crossed edge that begins in a corner. The ring holds the positions
  /// in `cells` of the four around the edge, counter-clockwise seen from outside; ring[2] is the
  /// cell that begins in the same corner.
  /// @param corner  position in the grid's corners, rising from call to call
  template <typename Visit>
  void from_corner(std::size_t corner, const Visit& visit) {
    std::array<std::uint32_t, 4> ring{};
    for (int axis = 0; axis < 3; ++axis) {
      if (ring_of(corner, axis, ring)) visit(ring);
    }
  }

 private:
  [[nodiscard]] bool ring_of(std::size_t corner, int axis, std::array<std::uint32_t, 4>& ring);

  const CornerValues& grid_;
  std::vector<KeyCursor> ends_;    ///< of the edges, by axis
  std::vector<KeyCursor> around_;  ///< the cells around the edges, four by axis
};

}  // namespace flytri
