/// @file  Scans with a sensor that does not know that a projector has moved.
#pragma once

#include <vector>

#include "core/calibration/record/calibration.h"
#include "core/refinement/refine.h"

namespace flytri::testing {

/// Projection center of the camera, sensor frame.
inline const Vec3 kCameraCenter_mm(0.0, 0.0, -60.0);

/// A calibration of that camera; it has no lines.
[[nodiscard]] calibration::Calibration camera_calibration();

/// Gives the views sheets that cross the rays of the camera at an angle.
[[nodiscard]] std::vector<AlignedView> with_tilted_sheets(std::vector<AlignedView> views);

/// The views as the sensor measures them.
[[nodiscard]] std::vector<AlignedView> misled(std::vector<AlignedView> views,
                                              const refinement::ProjectorMotion& moved);

/// A projector that moves by 20 µm across its lines and turns a little.
[[nodiscard]] refinement::ProjectorMotion bump(Pattern pattern, double from_s);

}  // namespace flytri::testing
