/// @file  How large a target must be: what the measurement camera sees of it.
#pragma once

#include <Eigen/Geometry>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::sheets {

using Field = Eigen::AlignedBox2d;

/// The part of the plane at `z_mm` that a camera sees, as a box in x and y of the sensor frame, mm.
[[nodiscard]] Field seen_field(const simulated::CameraModel& camera, double z_mm);

/// What the measurement camera sees of a target at `z_mm`, and the cross-section of the volume. The
/// texture camera is calibrated inside the volume only.
[[nodiscard]] Field target_field(const simulated::SensorModel& sensor, double z_mm);

}  // namespace flytri::sheets
