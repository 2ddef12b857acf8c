/// @file  How large a target must be: what the measurement camera sees of it.
#pragma once

#include <Eigen/Geometry>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::sheets {

using Field = Eigen::AlignedBox2d;

/// The part of the plane z = `z_mm` that a camera sees: a box in x and y, sensor frame, mm.
[[nodiscard]] Field seen_field(const simulated::CameraModel& camera, double z_mm);

/// The size of a target at `z_mm`: all that the measurement camera sees, and at least the volume's
/// width and height. The texture camera needs the target only inside the volume.
[[nodiscard]] Field target_field(const simulated::SensorModel& sensor, double z_mm);

}  // namespace flytri::sheets
