/// @file  Scans with a camera whose rows are exposed one after another.
#pragma once

#include <vector>

#include "core/geometry/view.h"
#include "core/refinement/rolling_shutter.h"

namespace flytri::testing {

/// The rows of camera_calibration().
[[nodiscard]] trajectory::RowShare camera_rows();

/// The views as such a camera sees them.
/// @param views  with their true poses and points
[[nodiscard]] std::vector<AlignedView> rolled(std::vector<AlignedView> views, double readout_s);

}  // namespace flytri::testing
