/// @file  Pictures for the guest that follows docs/building.md, and the check of its result.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/base/workers.h"

namespace flytri::scan {

/// Number of depths for each target of the calibration.
inline constexpr int kPlanes = 5;

/// Writes the pictures of all places, a folder each (see usb::Picture):
///   white      a white sheet at rest, for flytri setup
///   target-N   the placements of the guided calibration, in its order, from 1
///   check-N    the places of flytri calibrate --check, in its order, from 1
///   plane      a white sheet that turns slowly
///   jaw        the sample jaw: first at rest, then scanned
/// and the files "planes" (kPlanes) and "duration" (of the scan, s).
/// @errors  As SimulatedShots::create, ScanPictures::create, create_folder and write_file.
[[nodiscard]] Result<void> write_guide(const std::filesystem::path& folder, const Workers& workers);

/// Writes the truth of scan/, recorded at the place "jaw". Only once: it changes the frame times.
/// @errors  As open_recording, write_truth and write_ply.
[[nodiscard]] Result<void> write_guide_truth(const std::filesystem::path& folder,
                                             const Workers& workers);

/// Checks that the residuals of calibration/calibration.json are not larger than those of
/// simulated/calibration.json, which was made from the same targets without devices, and that
/// scan.json, of flytri evaluate, has a small error.
/// @errors  As read_calibration; kInconsistent: they are larger.
[[nodiscard]] Result<void> judge_guide(const std::filesystem::path& folder);

}  // namespace flytri::scan
