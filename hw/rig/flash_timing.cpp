#include "hw/rig/flash_timing.h"

#include <algorithm>
#include <cmath>

namespace flytri::rig {

namespace {

/// Assumed exposure, as a share of the frame period, if the camera's exposure is unknown.
constexpr double kUnknownExposure = 0.5;
constexpr int kMaxFlashFrames = 10;

}  // namespace

int flash_frames(const FlashCameras& cameras) {
  const double period_s = 1.0 / cameras.texture.rate_hz;
  const double window_s =
      cameras.texture.exposure_s.value_or(kUnknownExposure * period_s) + cameras.texture_readout_s;
  const double frames = (period_s + window_s) * cameras.measurement.rate_hz;
  return std::clamp(static_cast<int>(std::ceil(frames)), 1, kMaxFlashFrames);
}

Result<void> check_flash_period(double period_s, const FlashCameras& cameras,
                                const device::LightLimit& limit) {
  const double flash_s = flash_frames(cameras) / cameras.measurement.rate_hz;
  if (flash_s > kPlannedShare * limit.max_on_s)
    return fail(ErrorCode::kBadOption,
                "a flash must last {:.2f} s, so that the texture camera sees a whole one, but "
                "lights.flash.max_on_s in rig.json allows only {:g} s: choose a higher rate or a "
                "shorter exposure of the texture camera",
                flash_s, limit.max_on_s);
  const double shortest_s = flash_s / (kPlannedShare * limit.max_duty);
  if (period_s >= shortest_s) return {};
  return fail(ErrorCode::kBadOption,
              "flash_period_s {:g} in rig.json is too short: a flash lasts {:.2f} s and would be "
              "on for {:.0f} % of the time, but lights.flash.max_duty allows {:.0f} %: set "
              "flash_period_s to {:.2f} or more",
              period_s, flash_s, 100.0 * std::min(1.0, flash_s / period_s), 100.0 * limit.max_duty,
              std::ceil(100.0 * shortest_s) / 100.0);
}

}  // namespace flytri::rig
