/// @file  Images for a guided calibration in the virtual machine, and the check of its result.
#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace flytri::scan {

/// Number of depths for each target.
inline constexpr int kPlanes = 5;

/// Writes rig.json and the images of all placements. The folder "pictures/PLACEMENT/" (numbered
/// from 1 in the order of the dialog) has the images of the USB cameras under each light: one per
/// averaged exposure, each with different noise.
/// @errors  As SimulatedShots::create, create_folder and write_file.
[[nodiscard]] Result<void> write_targets(const std::filesystem::path& folder);

/// Checks that the residuals of recorded/calibration.json are not larger than those of
/// simulated/calibration.json, which was made from the same targets without devices.
/// @errors  As read_calibration; kInconsistent: they are larger.
[[nodiscard]] Result<void> check_fits(const std::filesystem::path& folder);

}  // namespace flytri::scan
