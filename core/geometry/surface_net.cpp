#include "core/geometry/surface_net.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flytri {

std::uint32_t KeyCursor::find(CellKey key) {
  std::size_t step = 1;
  if (at_ >= keys_.size() || keys_[at_] > key) at_ = 0;
  while (at_ + step < keys_.size() && keys_[at_ + step] < key) {
    at_ += step;
    step *= 2;
  }
  const auto begin = keys_.begin() + static_cast<std::ptrdiff_t>(at_);
  const auto end =
      keys_.begin() + static_cast<std::ptrdiff_t>(std::min(at_ + step + 1, keys_.size()));
  at_ = static_cast<std::size_t>(std::lower_bound(begin, end, key) - keys_.begin());
  return at_ < keys_.size() && keys_[at_] == key ? static_cast<std::uint32_t>(at_) : kNotThere;
}

std::array<float, 8> CornerReader::around(CellKey cell) {
  std::array<float, 8> values{};
  values.fill(std::numeric_limits<float>::quiet_NaN());
  for (std::size_t row = 0; row < 4; ++row) {
    const CellKey first = corner_of(cell, static_cast<int>(2 * row));
    const std::uint32_t at = rows_[row].find(first);
    if (at == KeyCursor::kNotThere) continue;
    values[2 * row] = grid_.values[at];
    const bool has_next =
        at + 1 < grid_.corners.size() && grid_.corners[at + 1] == grid_step(first, 0, 1);
    if (has_next) values[2 * row + 1] = grid_.values[at + 1];
  }
  return values;
}

bool is_crossed(const std::array<float, 8>& values) {
  int inside = 0;
  for (const float value : values) {
    if (std::isnan(value)) return false;
    inside += value < 0.0F ? 1 : 0;
  }
  return inside != 0 && inside != 8;
}

bool NetEdges::ring_of(std::size_t corner, int axis, std::array<std::uint32_t, 4>& ring) {
  const CellKey begin = grid_.corners[corner];
  const std::uint32_t end = ends_[static_cast<std::size_t>(axis)].find(grid_step(begin, axis, 1));
  if (end == KeyCursor::kNotThere) return false;
  const float value = grid_.values[corner], value_at_end = grid_.values[end];
  if (std::isnan(value) || std::isnan(value_at_end) || (value < 0.0F) == (value_at_end < 0.0F)) {
    return false;
  }
  // Counter-clockwise seen from the edge's end.
  const auto before = [](CellKey key, int along) { return grid_step(key, along % 3, -1); };
  const std::array<CellKey, 4> cells = {before(before(begin, axis + 1), axis + 2),
                                        before(begin, axis + 2), begin, before(begin, axis + 1)};
  for (std::size_t i = 0; i < 4; ++i) {
    ring[i] = around_[4 * static_cast<std::size_t>(axis) + i].find(cells[i]);
    if (ring[i] == KeyCursor::kNotThere) return false;
  }
  // Outwards is where the value rises.
  if (value >= 0.0F) std::swap(ring[1], ring[3]);
  return true;
}

}  // namespace flytri
