/// @file  The calibration target's dots as a camera sees them.
#pragma once

#include <opencv2/core.hpp>

#include "hw/simulated/sensor_model.h"

namespace flytri {

/// The plane z = `z_mm` with bright dots on black under even light.
/// @return  CV_32FC1, share of full scale, without noise
[[nodiscard]] cv::Mat dot_light(const CameraModel& camera, const DotTarget& target, double z_mm);

}  // namespace flytri
