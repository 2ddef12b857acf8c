/// @file  Runs the cameras of a rig together for a moment, to find what only shows then.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "hw/device/clock.h"
#include "hw/rig/rig_settings.h"

namespace flytri::rig {

/// Starts all cameras with their settings and reads them. Finds a bus that is too slow for both, a
/// rate that the camera does not keep, settings out of range, an exposure longer than a frame, and
/// missing or damaged images.
/// @param duration_s  > 0, time to read; a second shows the rate to some percent
/// @return  each problem, with what to do about it; empty if none was found
[[nodiscard]] std::vector<Error> check_streams(const RigSettings& rig, const CameraDrivers& drivers,
                                               const device::Clock& clock, double duration_s = 1.0);

}  // namespace flytri::rig
