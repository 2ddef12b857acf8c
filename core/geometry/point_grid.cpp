#include "core/geometry/point_grid.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/square.h"

namespace flytri {
namespace {

constexpr std::uint32_t kNoRow = std::numeric_limits<std::uint32_t>::max();

/// Distance from `x` to the interval of cell `i`.
float gap_to_cell(float x, std::int32_t i, float cell) {
  const float low = static_cast<float>(i) * cell;
  return std::max(std::max(low - x, x - (low + cell)), 0.0F);
}

bool is_nearer(const Neighbor& a, const Neighbor& b) {
  return a.distance2_mm2 != b.distance2_mm2 ? a.distance2_mm2 < b.distance2_mm2 : a.index < b.index;
}

}  // namespace

PointGrid::PointGrid(std::span<const Vec3f> points_mm, float cell_mm)
    : inverse_cell_(1.0F / cell_mm), cell_mm_(cell_mm) {
  assert(cell_mm > 0.0F);
  struct Keyed {
    CellKey row;
    float x;
    std::uint32_t index;
  };
  std::vector<Keyed> order(points_mm.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec3f& p = points_mm[i];
    order[i] = {CellKey(0, cell_of(p.y()), cell_of(p.z())), p.x(), static_cast<std::uint32_t>(i)};
  }
  std::sort(order.begin(), order.end(), [](const Keyed& a, const Keyed& b) {
    if (a.row != b.row) return a.row < b.row;
    return a.x != b.x ? a.x < b.x : a.index < b.index;
  });
  std::vector<CellKey> entry_keys(order.size());
  points_.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    entry_keys[i] = order[i].row;
    points_[i] = {points_mm[order[i].index], order[i].index};
  }
  build_rows(entry_keys);
}

std::int32_t PointGrid::cell_of(float coordinate_mm) const {
  return CellKey::number(coordinate_mm * inverse_cell_);
}

void PointGrid::build_rows(const std::vector<CellKey>& entry_keys) {
  for (std::size_t i = 0; i < entry_keys.size(); ++i) {
    const auto at = static_cast<std::uint32_t>(i);
    if (i == 0 || entry_keys[i] != entry_keys[i - 1]) rows_.push_back({entry_keys[i], at, at});
    rows_.back().end = at + 1;
  }
  slots_.assign(std::bit_ceil(2 * rows_.size() + 1), kNoRow);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    std::size_t slot = hash_of(rows_[r].key) & (slots_.size() - 1);
    while (slots_[slot] != kNoRow) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = static_cast<std::uint32_t>(r);
  }
}

const PointGrid::Row* PointGrid::find_row(CellKey key) const {
  std::size_t slot = hash_of(key) & (slots_.size() - 1);
  for (; slots_[slot] != kNoRow; slot = (slot + 1) & (slots_.size() - 1)) {
    if (rows_[slots_[slot]].key == key) return &rows_[slots_[slot]];
  }
  return nullptr;
}

template <typename BeginAt, typename Visit>
void PointGrid::visit_rows(const Vec3f& center_mm, float radius_mm, const float& limit2_mm2,
                           const BeginAt& begin_at, const Visit& visit) const {
  const std::int32_t z_end = cell_of(center_mm.z() + radius_mm);
  const std::int32_t y_begin = cell_of(center_mm.y() - radius_mm);
  const std::int32_t y_end = cell_of(center_mm.y() + radius_mm);
  for (std::int32_t iz = cell_of(center_mm.z() - radius_mm); iz <= z_end; ++iz) {
    const float gap_z2 = square(gap_to_cell(center_mm.z(), iz, cell_mm_));
    for (std::int32_t iy = y_begin; iy <= y_end; ++iy) {
      const float gap2 = gap_z2 + square(gap_to_cell(center_mm.y(), iy, cell_mm_));
      // The bounds of the cell are rounded: the margin keeps points on the bounds.
      const float rest2 = limit2_mm2 * 1.0001F - gap2;
      if (rest2 < 0.0F) continue;
      const float reach_x = std::sqrt(rest2);
      const auto [row, begin] = begin_at(iy, iz, center_mm.x() - reach_x);
      if (row != nullptr) visit(begin, row->end, center_mm.x() + reach_x);
    }
  }
}

std::uint32_t PointGrid::first_from(const Row& row, float x_mm) const {
  const auto first =
      std::lower_bound(points_.begin() + row.begin, points_.begin() + row.end, x_mm,
                       [](const Entry& e, float x) { return e.position_mm.x() < x; });
  return static_cast<std::uint32_t>(first - points_.begin());
}

template <typename Visit>
void PointGrid::visit_within(const Vec3f& center_mm, float radius_mm, const Visit& visit) const {
  float limit2 = square(radius_mm);
  const auto begin_at = [&](std::int32_t iy, std::int32_t iz, float x_mm) {
    const Row* row = find_row({0, iy, iz});
    return std::pair(row, row == nullptr ? 0U : first_from(*row, x_mm));
  };
  visit_rows(center_mm, radius_mm, limit2, begin_at,
             [&](std::uint32_t i, std::uint32_t end, float end_x_mm) {
               for (; i != end && points_[i].position_mm.x() <= end_x_mm; ++i) {
                 const float distance2 = (points_[i].position_mm - center_mm).squaredNorm();
                 if (distance2 <= limit2) limit2 = visit(points_[i], distance2);
               }
             });
}

std::pair<const PointGrid::Row*, std::uint32_t> PointWalk::begin_at(std::int32_t iy,
                                                                    std::int32_t iz, float x_mm) {
  /// From an entry farther off than this, the first one is searched anew.
  constexpr std::uint32_t kSteps = 8;
  const std::vector<PointGrid::Entry>& points = grid_.points_;
  const auto digit = [](std::int32_t i) { return static_cast<std::uint32_t>(i) % kSide; };
  Place& place = places_[digit(iz) * kSide + digit(iy)];
  const CellKey key{0, iy, iz};
  if (!place.is_known || place.key != key) {
    place = {key, grid_.find_row(key), 0, true};
    if (place.row != nullptr) place.at = grid_.first_from(*place.row, x_mm);
    return {place.row, place.at};
  }
  if (place.row == nullptr) return {nullptr, 0};
  std::uint32_t at = place.at, steps = 0;
  for (; at > place.row->begin && points[at - 1].position_mm.x() >= x_mm && steps < kSteps; --at)
    ++steps;
  for (; at < place.row->end && points[at].position_mm.x() < x_mm && steps < kSteps; ++at) ++steps;
  place.at = steps < kSteps ? at : grid_.first_from(*place.row, x_mm);
  return {place.row, place.at};
}

std::span<const Neighbor> PointWalk::within(const Vec3f& center_mm, float radius_mm) {
  const float radius2 = square(radius_mm);
  const std::vector<PointGrid::Entry>& points = grid_.points_;
  std::size_t count = 0;
  grid_.visit_rows(
      center_mm, radius_mm, radius2,
      [&](std::int32_t iy, std::int32_t iz, float x_mm) { return begin_at(iy, iz, x_mm); },
      [&](std::uint32_t i, std::uint32_t end, float end_x_mm) {
        for (; i != end && points[i].position_mm.x() <= end_x_mm; ++i) {
          if (count == found_.size()) found_.resize(2 * count + kSide);
          // Written in any case, and counted if it is near: no branch that is hard to foresee.
          const float distance2 = (points[i].position_mm - center_mm).squaredNorm();
          found_[count] = {points[i].index, distance2};
          count += distance2 <= radius2 ? 1 : 0;
        }
      });
  return std::span(found_).first(count);
}

void PointGrid::within(const Vec3f& center_mm, float radius_mm,
                       std::vector<Neighbor>& found) const {
  found.clear();
  const float radius2 = square(radius_mm);
  visit_within(center_mm, radius_mm, [&](const Entry& entry, float distance2) {
    found.push_back({entry.index, distance2});
    return radius2;
  });
}

std::optional<Neighbor> PointGrid::nearest(const Vec3f& center_mm, float max_distance_mm) const {
  std::optional<Neighbor> best;
  // Small radius first: most searches end there.
  for (float radius = std::min(cell_mm_, max_distance_mm); !best; radius *= 2.0F) {
    radius = std::min(radius, max_distance_mm);
    visit_within(center_mm, radius, [&](const Entry& entry, float distance2) {
      const Neighbor candidate{entry.index, distance2};
      if (!best || is_nearer(candidate, *best)) best = candidate;
      return best->distance2_mm2;
    });
    if (radius >= max_distance_mm) break;
  }
  return best;
}

void PointGrid::nearest(const Vec3f& center_mm, std::size_t count, float max_distance_mm,
                        std::vector<Neighbor>& found) const {
  found.clear();
  for (float radius = std::min(cell_mm_, max_distance_mm);; radius *= 2.0F) {
    radius = std::min(radius, max_distance_mm);
    within(center_mm, radius, found);
    if (found.size() >= count || radius >= max_distance_mm) break;
  }
  const std::size_t kept = std::min(count, found.size());
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end(),
                    is_nearer);
  found.resize(kept);
}

}  // namespace flytri
