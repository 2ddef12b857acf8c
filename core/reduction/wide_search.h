/// @file  Finds the points near a place. The next place, if it is close, needs no new search.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/point_grid.h"

namespace flytri::reduction {

/// Searches farther than needed, so that one list serves for several places.
class WideSearch {
 public:
  /// @param grid      kept by reference
  /// @param reach_mm  > 0. The list has all points this near to the place
  /// @param slack_mm  > 0. Places nearer than this to the last one use its list
  WideSearch(const PointGrid& grid, float reach_mm, float slack_mm)
      : grid_(grid), reach_mm_(reach_mm), slack_mm_(slack_mm) {}

  /// Makes the list serve for a place.
  /// @return  whether it is a new list
  bool go_to(const Vec3f& place_mm) {
    const bool is_near = (place_mm - middle_mm_).squaredNorm() <= slack_mm_ * slack_mm_;
    if (is_near && !found_.empty()) return false;
    middle_mm_ = place_mm;
    // Rounding must not lose a point at the border.
    grid_.within(place_mm, 1.001F * (reach_mm_ + slack_mm_), found_);
    return true;
  }
  [[nodiscard]] std::span<const Neighbor> found() const { return found_; }

 private:
  const PointGrid& grid_;
  float reach_mm_, slack_mm_;
  Vec3f middle_mm_ = Vec3f::Zero();  ///< of the last search
  std::vector<Neighbor> found_;
};

}  // namespace flytri::reduction
