/// @file  How long a flash lasts, and whether the light may be on that often.
#pragma once

#include "core/base/result.h"
#include "hw/device/camera.h"
#include "hw/device/light_limits.h"

namespace flytri::rig {

/// What decides how long a flash lasts.
struct FlashCameras {
  device::CameraSettings measurement;
  device::CameraSettings texture;  ///< without an exposure: half of the frame period is assumed
  double texture_readout_s = 0.0;  ///< >= 0, see RigCamera::readout_s
};

/// Duration of a flash in frames of the measurement camera, 1..10, so that a whole exposure of the
/// texture camera fits.
[[nodiscard]] int flash_frames(const FlashCameras& cameras);

/// Share of a limit that the plan may use; the light switch acts at 0.9 of each limit.
inline constexpr double kPlannedShare = 0.85;

/// @param period_s  > 0, time from one flash to the next
/// @errors  kBadOption: such flashes exceed the limit; the message gives the shortest period.
[[nodiscard]] Result<void> check_flash_period(double period_s, const FlashCameras& cameras,
                                              const device::LightLimit& limit);

}  // namespace flytri::rig
