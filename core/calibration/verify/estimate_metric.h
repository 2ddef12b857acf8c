/// @file  Estimates from a sphere of known size how a calibration's millimeters differ from true
/// ones.
#pragma once

#include <vector>

#include "core/calibration/record/metric_correction.h"
#include "core/calibration/verify/verification_report.h"

namespace flytri::calibration {

struct MetricEstimate {
  MetricCorrection correction;
  MetricCorrection uncertainty;  ///< standard uncertainty of each number
};

/// A sphere that a sheared or scaled sensor measures is an ellipsoid. One place of the sphere in
/// the middle tells the shear; places at the sides and depths tell the scales.
/// @param poses  of the sphere at rest or in slow motion
/// @param diameter_mm  > 0, true diameter
/// @errors  kInsufficient: the sphere was not seen well enough to tell.
[[nodiscard]] Result<MetricEstimate> estimate_metric(const std::vector<VerificationPose>& poses,
                                                     double diameter_mm);

}  // namespace flytri::calibration
