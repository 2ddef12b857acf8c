/// @file  Finds points near a place: all within a radius, or the nearest ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/cell_key.h"

namespace flytri {

/// A point found by a search.
struct Neighbor {
  std::uint32_t index = 0;     ///< position in the list that the grid was built from
  float distance2_mm2 = 0.0F;  ///< squared distance to the center of the search
};

/// An immutable copy of the points, sorted into rows of a uniform grid and by x within each row, so
/// that a search reads few contiguous ranges of memory. Searches are thread-safe.
///
/// docs/adr/0003-meshing.md compares the grid with a k-d tree.
class PointGrid {
 public:
  /// @param points_mm  those a million cells away from the origin, or farther, may not be found
  /// @param cell_mm  > 0: width of a row. Fastest near the usual search radius.
  PointGrid(std::span<const Vec3f> points_mm, float cell_mm);

  [[nodiscard]] std::size_t size() const { return points_.size(); }

  /// Replaces `found` by all points at most `radius_mm` from `center_mm`. Their order is
  /// reproducible, but not sorted.
  void within(const Vec3f& center_mm, float radius_mm, std::vector<Neighbor>& found) const;

  /// The nearest point at most `max_distance_mm` away, if any; among equal distances the lowest
  /// index.
  [[nodiscard]] std::optional<Neighbor> nearest(const Vec3f& center_mm,
                                                float max_distance_mm) const;

  /// Replaces `found` by the `count` nearest points at most `max_distance_mm` away, nearest first.
  void nearest(const Vec3f& center_mm, std::size_t count, float max_distance_mm,
               std::vector<Neighbor>& found) const;

 private:
  struct Entry {
    Vec3f position_mm;
    std::uint32_t index;
  };
  /// Consecutive entries of one row.
  struct Row {
    CellKey key;  ///< of its cell with x = 0
    std::uint32_t begin, end;
  };

  [[nodiscard]] std::int32_t cell_of(float coordinate_mm) const;
  void build_rows(const std::vector<CellKey>& entry_keys);
  [[nodiscard]] const Row* find_row(CellKey key) const;
  /// Calls visit(entry, squared distance) for entries within the radius; visit returns the squared
  /// radius for the rest of the search.
  template <typename Visit>
  void visit_within(const Vec3f& center_mm, float radius_mm, const Visit& visit) const;

  float inverse_cell_;
  float cell_mm_;
  std::vector<Entry> points_;  ///< by row, then x, then index
  std::vector<Row> rows_;
  std::vector<std::uint32_t> slots_;  ///< hash table into rows_, kNoRow where empty
};

}  // namespace flytri
