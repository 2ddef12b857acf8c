#include "core/registration/overlap_grid.h"

#include <algorithm>
#include <cmath>

namespace flytri::registration {
namespace {

/// Views whose sight directions have a smaller cosine than this show little common surface.
constexpr double kMinSightCosine = 0.2;

double worth(const ViewExtent& a, const ViewExtent& b) {
  if (a.sight.dot(b.sight) < kMinSightCosine) return 0.0;
  const double reach_mm = 1.2 * (a.radius_mm + b.radius_mm);
  const double shared = std::max(0.0, 1.0 - (a.center_mm - b.center_mm).norm() / reach_mm);
  const double cosine = a.line_direction.dot(b.line_direction);
  return shared * std::max(0.0, 1.0 - cosine * cosine);
}

}  // namespace

void OverlapGrid::add(const ViewExtent& extent) {
  cells_[cell_of(extent.center_mm)].push_back(extents_.size());
  extents_.push_back(extent);
}

void OverlapGrid::move(std::size_t view, const ViewExtent& extent) {
  std::erase(cells_[cell_of(extents_[view].center_mm)], view);
  cells_[cell_of(extent.center_mm)].push_back(view);
  extents_[view] = extent;
}

void OverlapGrid::remove(std::size_t view) {
  std::erase(cells_[cell_of(extents_[view].center_mm)], view);
}

std::vector<Overlap> OverlapGrid::overlapping(const ViewExtent& around) const {
  const Vec3 reach = Vec3::Constant(2.4 * around.radius_mm);
  const CellKey low = cell_of(around.center_mm - reach);
  const CellKey high = cell_of(around.center_mm + reach);
  std::vector<Overlap> result;
  for (int x = low[0]; x <= high[0]; ++x) {
    for (int y = low[1]; y <= high[1]; ++y) {
      // The cells of a column are neighbors in the map.
      const auto end = cells_.upper_bound({x, y, high[2]});
      for (auto cell = cells_.lower_bound({x, y, low[2]}); cell != end; ++cell) {
        for (const std::size_t view : cell->second) {
          const double value = worth(around, extents_[view]);
          if (value > 0.0) result.push_back({view, value});
        }
      }
    }
  }
  std::sort(result.begin(), result.end(),
            [](const Overlap& a, const Overlap& b) { return a.view < b.view; });
  return result;
}

}  // namespace flytri::registration
