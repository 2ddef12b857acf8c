/// @file  Takes exposure steps with a rig, and judges whether its cameras are linear.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "hw/rig/linearity.h"
#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"

namespace flytri::shots {

/// Of one camera.
struct LinearityReport {
  std::string camera;  ///< its name
  std::vector<rig::ExposureStep> steps;
  rig::Linearity linearity;
};

/// Creates the devices of a rig, as rig::open_devices does.
using OpenDevices = std::function<Result<rig::RigDevices>(const rig::RigSettings&)>;

/// Lights a white sheet with the flash and takes eight exposures with each camera, from a quarter
/// of the rig's exposure to twice of it.
/// @param rig  with a texture camera, and the exposures of both cameras
/// @errors  kBadOption: as judge_linearity, or an exposure is missing in rig.json; of the devices;
///          kCancelled.
[[nodiscard]] Result<std::vector<LinearityReport>> check_linearity(const rig::RigSettings& rig,
                                                                   const OpenDevices& open,
                                                                   const Progress& progress);

/// What to do about a camera that is not linear; empty if it is.
[[nodiscard]] std::string advice_on(const LinearityReport& report);

}  // namespace flytri::shots
