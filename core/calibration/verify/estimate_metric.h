/// @file  Estimates from a sphere of known size how a calibration's millimeters differ from true
/// ones.
#pragma once

#include <vector>

#include "core/calibration/record/metric_correction.h"
#include "core/calibration/verify/verification_report.h"

namespace flytri::calibration {

struct MetricEstimate {
  MetricCorrection correction;  ///< its scales are 1
  Eigen::Vector2d uncertainty;  ///< standard uncertainty of the shear
};

/// A sphere that a sheared sensor measures is a leaning ellipsoid. Scales are not estimated: the
/// cap of a sphere, made smaller across and much smaller in depth, stays nearly a cap of the same
/// sphere, so that noise decides. A common scale shows in the diameter, see check_on_sphere().
/// @param poses  of the sphere at rest or in slow motion
/// @param diameter_mm  > 0, true diameter
/// @errors  kInsufficient: the sphere was not seen well enough to tell.
[[nodiscard]] Result<MetricEstimate> estimate_metric(const std::vector<VerificationPose>& poses,
                                                     double diameter_mm);

}  // namespace flytri::calibration
