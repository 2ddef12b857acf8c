#include "hw/rig/rig_settings.h"

namespace flytri::rig {

Result<void> RigCamera::validate() const {
  if (match == device::CameraMatch{})
    return fail(ErrorCode::kBadOption,
                "a camera of the rig must be told by its name, serial number or bus path");
  if (!(readout_s >= 0.0))
    return fail(ErrorCode::kBadOption, "readout_s must be at least 0, not {}", readout_s);
  return settings.validate();
}

Result<void> RigSettings::validate() const {
  if (auto valid = measurement.validate(); !valid) return valid;
  if (measurement.settings.channels != device::Channels::kGrey)
    return fail(ErrorCode::kBadOption, "the measurement camera must deliver grey images");
  if (texture) {
    if (auto valid = texture->validate(); !valid) return valid;
    if (!lights.flash)
      return fail(ErrorCode::kBadOption, "a texture camera needs a flash among the lights");
  }
  if (!(flash_period_s > 0.0))
    return fail(ErrorCode::kBadOption, "flash_period_s must be above 0, not {}", flash_period_s);
  return lights.validate();
}

}  // namespace flytri::rig
