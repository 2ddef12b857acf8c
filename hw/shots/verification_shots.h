/// @file  What a check of a calibration looks at: an object at rest, or a recording of a moving
/// one.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/calibration/verify/verification_report.h"
#include "hw/shots/shot_source.h"

namespace flytri::shots {

/// Where a user is asked to hold the object.
struct VerificationPlace {
  double depth_share;  ///< -0.5..0.5 of the volume's depth
  std::string_view words;
};
/// Near and far, upright and tilted: what the poses share shows only where they differ.
[[nodiscard]] std::span<const VerificationPlace> verification_places();

/// The object where it is now, under both patterns and the first one again.
/// @param z_mm  where it is to be, see ShotSource
/// @errors  As ShotSource::take and measure_view; kInconsistent: it moved meanwhile.
[[nodiscard]] Result<calibration::VerificationPose> take_verification_pose(
    ShotSource& source, double z_mm, const calibration::Calibration& calibration,
    const Progress& progress);

/// The measurement frames of a recording in which the object moves slowly. Frames that cannot be
/// read or show nothing are left out.
/// @errors  As open_recording; kCancelled.
[[nodiscard]] Result<std::vector<calibration::VerificationPose>> read_verification_poses(
    const std::filesystem::path& recording, const calibration::Calibration& calibration,
    const Progress& progress);

}  // namespace flytri::shots
