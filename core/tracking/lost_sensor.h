/// @file  Where a lost sensor probably is.
#pragma once

#include <optional>

#include "core/geometry/rigid.h"

namespace flytri::tracking {

/// What the latest search found out about a lost sensor.
struct LostSensor {
  /// Likely, but not certain: odds of a thousand to one for a view that fits.
  std::optional<Isometry> T_world_sensor;
  bool is_featureless = false;  ///< what it sees there does not fix its pose: flat or round
};

}  // namespace flytri::tracking
