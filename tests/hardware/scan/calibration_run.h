/// @file  A calibration at the chair in the virtual machine: its targets as pictures, and what came
/// of them.
#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace flytri::scan {

/// Of the volume: the depths at which both targets stand.
inline constexpr int kPlanes = 5;

/// Writes rig.json, and into "pictures/PLACEMENT/", from 1 on in the order in which the dialog asks
/// for them, what the USB cameras see of the target there under each light: as many exposures as
/// are averaged, each with its own noise.
/// @errors  As SimulatedShots::create, create_folder and write_file.
[[nodiscard]] Result<void> write_targets(const std::filesystem::path& folder);

/// That the residuals of recorded/calibration.json are those of simulated/calibration.json, which
/// was made of images of the same targets without devices.
/// @errors  As read_calibration; kInconsistent: they are larger.
[[nodiscard]] Result<void> check_fits(const std::filesystem::path& folder);

}  // namespace flytri::scan
