/// @file  In which row of the image a measured point was seen.
#pragma once

#include "core/calibration/record/calibration.h"
#include "core/refinement/rolling_shutter.h"

namespace flytri::reconstruct {

/// @param calibration  must outlive the result
[[nodiscard]] inline trajectory::RowShare row_share_of(
    const calibration::Calibration& calibration) {
  return [&calibration](const Vec3& p_mm) {
    const double row = calibration.project_to_measurement(p_mm).v_px + 0.5;
    return row / calibration.measurement_size.height_px - 0.5;
  };
}

}  // namespace flytri::reconstruct
