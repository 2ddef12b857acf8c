/// @file  The readout of a rolling shutter, and the views of a scan without its effect.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/view.h"
#include "core/trajectory/rolling_shutter.h"

namespace flytri::refinement {

/// The readout of a rolling shutter.
struct Readout {
  double readout_s = 0.0;  ///< delay of the last row after the first; < 0: the last row comes first
  double uncertainty_s = 0.0;  ///< standard uncertainty

  /// Whether it is surely that of a rolling shutter, and long enough to spoil a model.
  [[nodiscard]] bool is_long() const;
};

/// Velocity of the sensor by view, as the poses show it.
/// @param views  by rising time. Views without points are left out: they have not been optimized
/// @param poses  T_world_sensor, by view
[[nodiscard]] std::vector<Twist> velocities_of(std::span<const AlignedView> views,
                                               std::span<const Isometry> poses);

/// The views as a global shutter would have seen them, with velocities_of() them.
[[nodiscard]] std::vector<AlignedView> without_rolling_shutter(
    std::vector<AlignedView> views, double readout_s, const trajectory::RowShare& row_share);

}  // namespace flytri::refinement
