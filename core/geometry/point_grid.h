/// @file  Finds points near a place: all within a radius, or the nearest ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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
  friend class PointWalk;
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
  /// The first entry of a row from x on, or its end.
  [[nodiscard]] std::uint32_t first_from(const Row& row, float x_mm) const;
  /// Calls visit(entry, squared distance) for entries within the radius; visit returns the squared
  /// radius for the rest of the search.
  template <typename Visit>
  void visit_within(const Vec3f& center_mm, float radius_mm, const Visit& visit) const;
  /// For each row within the radius: visit(first entry, end of the row, largest x). begin_at(y, z,
  /// x) tells the row and its first entry from x on. Rows farther away than the limit, which may
  /// fall meanwhile, are left out.
  template <typename BeginAt, typename Visit>
  void visit_rows(const Vec3f& center_mm, float radius_mm, const float& limit2_mm2,
                  const BeginAt& begin_at, const Visit& visit) const;

  float inverse_cell_;
  float cell_mm_;
  std::vector<Entry> points_;  ///< by row, then x, then index
  std::vector<Row> rows_;
  std::vector<std::uint32_t> slots_;  ///< hash table into rows_, kNoRow where empty
};

/// Searches a grid: fast if each place is near the last one, because it remembers where it has
/// read. Not thread-safe.
class PointWalk {
 public:
  /// @param grid  kept by reference
  explicit PointWalk(const PointGrid& grid) : grid_(grid) {}
  /// As PointGrid::within, in the same order; until the next search.
  [[nodiscard]] std::span<const Neighbor> within(const Vec3f& center_mm, float radius_mm);

 private:
  static constexpr std::size_t kSide = 8;
  struct Place {
    CellKey key{0, 0, 0};
    const PointGrid::Row* row = nullptr;  ///< null: the grid has no such row
    std::uint32_t at = 0;                 ///< an entry of the row, or its end
    bool is_known = false;
  };
  [[nodiscard]] std::pair<const PointGrid::Row*, std::uint32_t> begin_at(std::int32_t iy,
                                                                         std::int32_t iz,
                                                                         float x_mm);

  const PointGrid& grid_;
  std::array<Place, kSide * kSide> places_;  ///< by the last digits of y and z
  std::vector<Neighbor> found_;              ///< more than were found
};

}  // namespace flytri
