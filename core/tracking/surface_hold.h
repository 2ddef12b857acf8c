/// @file  How well the surface below the sensor fixes its pose.
#pragma once

#include <optional>

#include "core/geometry/rigid.h"

namespace flytri::tracking {

/// The direction in which the latest views fix their poses least.
struct WeakDirection {
  Vec3 center_mm = Vec3::Zero();   ///< of the latest view, world frame
  Vec3 direction = Vec3::UnitX();  ///< unit, world frame: of the shift, or the axis of the turn
  bool is_turn = false;
};

/// Of the latest registered views. Empty while tracking is lost.
struct SurfaceHold {
  /// Standard uncertainty of their poses in that direction, by the surface alone, relative to the
  /// largest that a view may have: from 1 on, the motion of the hand has to hold them.
  double weakness = 0.0;
  /// Tracking may soon be lost: the operator should show the sensor more structure.
  bool is_weak = false;
  std::optional<WeakDirection> direction;
};

}  // namespace flytri::tracking
