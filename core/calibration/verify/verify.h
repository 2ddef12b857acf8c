/// @file  Whether a calibration still holds, told from a plane or a sphere that the sensor looks
/// at.
#pragma once

#include <vector>

#include "core/calibration/verify/verification_report.h"

namespace flytri::calibration {

/// A plane at unknown places: it must come out flat, and both patterns must put it in one place.
/// A wrong scale does not show: a plane has no size.
/// @errors  kBadOption.
[[nodiscard]] Result<VerificationReport> check_on_plane(const std::vector<VerificationPose>& poses,
                                                        const Calibration& calibration,
                                                        const VerificationOptions& options = {});

/// A sphere at unknown places: it must have its diameter, and both patterns must agree.
/// @param diameter_mm  > 0, as it is known
/// @errors  kBadOption.
[[nodiscard]] Result<VerificationReport> check_on_sphere(const std::vector<VerificationPose>& poses,
                                                         double diameter_mm,
                                                         const Calibration& calibration,
                                                         const VerificationOptions& options = {});

/// Poses of an object that moves slowly: every three views in a row, one pattern before and after
/// the other, so that even motion cancels.
/// @param views  by time, patterns alternating; where they do not, views are left out
[[nodiscard]] std::vector<VerificationPose> moving_poses(const std::vector<View>& views);

}  // namespace flytri::calibration
