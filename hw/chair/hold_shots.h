/// @file  What a check of a calibration looks at: an object at rest, or a recording of a moving
/// one.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/calibrating/hold_report.h"
#include "hw/chair/shot_source.h"

namespace flytri {

/// Where a user is asked to hold the object.
struct HoldPlace {
  double depth_share;  ///< -0.5..0.5 of the volume's depth
  std::string_view words;
};
/// Near and far, upright and tilted: what the poses share shows only where they differ.
[[nodiscard]] std::span<const HoldPlace> hold_places();

/// The object where it is now, under both patterns and the first one again.
/// @param z_mm  where it is to be, see ShotSource
/// @errors  As ShotSource::take and measure_view; kInconsistent: it moved meanwhile.
[[nodiscard]] Result<HoldPose> take_hold_pose(ShotSource& source, double z_mm,
                                              const Calibration& calibration,
                                              const Progress& progress);

/// The measurement frames of a recording in which the object moves slowly. Frames that cannot be
/// read or show nothing are left out.
/// @errors  As open_recording; kCancelled.
[[nodiscard]] Result<std::vector<HoldPose>> read_hold_poses(const std::filesystem::path& recording,
                                                            const Calibration& calibration,
                                                            const Progress& progress);

}  // namespace flytri
