/// @file  Checks with a plane or a sphere whether a calibration is still valid.
#pragma once

#include <vector>

#include "core/calibration/verify/verification_report.h"

namespace flytri::calibration {

/// Checks with a plane at unknown poses: the measured plane must be flat, and both patterns must
/// measure it at the same place. This does not detect a wrong scale, because a plane has no size.
/// @errors  kBadOption.
[[nodiscard]] Result<VerificationReport> check_on_plane(const std::vector<VerificationPose>& poses,
                                                        const Calibration& calibration,
                                                        const VerificationOptions& options = {});

/// Checks with a sphere at unknown places: the measured diameter must be right, and both patterns
/// must agree.
/// @param diameter_mm  > 0, the true diameter
/// @errors  kBadOption.
[[nodiscard]] Result<VerificationReport> check_on_sphere(const std::vector<VerificationPose>& poses,
                                                         double diameter_mm,
                                                         const Calibration& calibration,
                                                         const VerificationOptions& options = {});

/// Poses of an object that moves slowly: groups of three successive views, one pattern before and
/// after the other, so that motion at constant speed cancels.
/// @param views  by time, patterns alternating; views that do not alternate are skipped
[[nodiscard]] std::vector<VerificationPose> moving_poses(const std::vector<View>& views);

}  // namespace flytri::calibration
