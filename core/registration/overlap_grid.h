/// @file  Finds registered views that overlap a given view, with a fixed grid of view centers.
#pragma once

#include <map>
#include <vector>

#include "core/geometry/cell_key.h"

namespace flytri::registration {

/// Position, direction and size of a view in the world frame (paper: position and basic
/// orientation).
struct ViewExtent {
  Vec3 center_mm = Vec3::Zero();        ///< center of mass
  Vec3 line_direction = Vec3::UnitX();  ///< along its profiles, unit
  Vec3 sight = Vec3::UnitZ();           ///< z axis of the sensor, pointing to the surface
  double radius_mm = 0.0;               ///< RMS distance of its points from the center
};

/// A view that is likely to overlap.
struct Overlap {
  std::size_t view = 0;  ///< in the order of add(), from 0
  /// 0..1: overlap of the extents times the squared sine of the angle between the profile
  /// directions. It estimates how much the crossings contribute.
  double worth = 0.0;
};

/// @source  Arold et al., "Multi-View Registration".
class OverlapGrid {
 public:
  /// @param cell_mm  > 0, side of the cubic cells: about the radius of a view.
  explicit OverlapGrid(double cell_mm) : cell_mm_(cell_mm) {}

  void add(const ViewExtent& extent);
  /// Call after a view was registered again.
  void move(std::size_t view, const ViewExtent& extent);
  /// Removes a view. The others keep their numbers.
  void remove(std::size_t view);
  [[nodiscard]] std::size_t size() const { return extents_.size(); }
  [[nodiscard]] const ViewExtent& extent(std::size_t view) const { return extents_[view]; }

  /// All views whose extent meets `around` and that see the surface from the same side, by rising
  /// number.
  [[nodiscard]] std::vector<Overlap> overlapping(const ViewExtent& around) const;

 private:
  [[nodiscard]] CellKey cell_of(const Vec3& p_mm) const { return CellKey::at(p_mm, cell_mm_); }

  double cell_mm_;
  std::vector<ViewExtent> extents_;
  std::map<CellKey, std::vector<std::size_t>> cells_;
};

}  // namespace flytri::registration
