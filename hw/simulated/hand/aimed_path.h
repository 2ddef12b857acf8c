/// @file  Plans a path along given targets, with the uneven pace and the tremor of a hand.
#pragma once

#include <functional>

#include "hw/device/steerable_hand.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {

/// Where the hand looks at a share of the way, 0..1.
using HandAims = std::function<device::HandAim(double progress)>;

/// As plan_path(), along `aims`.
/// @param options  `kind`, `up`, `front` and `tilt_rad` are not used.
/// @errors  As plan_path().
[[nodiscard]] Result<SensorPath> plan_aimed_path(const RayScene& scene, const SensorModel& sensor,
                                                 const HandAims& aims, const PathOptions& options);

}  // namespace flytri::simulated
