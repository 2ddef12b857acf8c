/// @file  Takes the measurements to verify a calibration: of an object at rest, or from a recording
/// of a moving object.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/calibration/verify/verification_report.h"
#include "hw/shots/shot_source.h"

namespace flytri::shots {

/// Where the user shall place the object.
struct VerificationPlace {
  double depth_share;  ///< -0.5..0.5 of the volume's depth
  std::string_view words;
};
/// The poses differ in depth and tilt: errors of the sensor are then common to all, errors of the
/// object are not.
[[nodiscard]] std::span<const VerificationPlace> verification_places();

/// Measures the object at its current place under both patterns, then under the first again.
/// @param z_mm  depth of the object, see ShotSource::take
/// @errors  As ShotSource::take and measure_view; kInconsistent: the object moved.
[[nodiscard]] Result<calibration::VerificationPose> take_verification_pose(
    ShotSource& source, double z_mm, const calibration::Calibration& calibration,
    const Progress& progress);

/// Measures the frames of a recording in which the object moves slowly. Skips frames that cannot be
/// read or measured.
/// @errors  As open_recording; kCancelled.
[[nodiscard]] Result<std::vector<calibration::VerificationPose>> read_verification_poses(
    const std::filesystem::path& recording, const calibration::Calibration& calibration,
    const Progress& progress);

}  // namespace flytri::shots
