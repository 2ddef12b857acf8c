/// @file  Compares the millimeters of a calibration with those of another one of the same sensor.
#pragma once

#include "core/calibration/record/metric_correction.h"
#include "core/calibration/verify/verification_report.h"

namespace flytri::calibration {

/// How the millimeters of a calibration differ from those of a reference.
struct CalibrationComparison {
  MetricCorrection correction;
  double lateral_sigma = 0.0, depth_sigma = 0.0;          ///< standard uncertainties
  Eigen::Vector2d shear_sigma = Eigen::Vector2d::Zero();  ///< of the shear
  double left_mm = 0.0;  ///< RMS distance between the places of both, after the correction
};

/// Locates the same lines at the same pixels with both. Their sensor frames may differ by a rigid
/// motion. A reference made by hand, without a stage, shows the errors of a stage.
/// @errors  kInconsistent: not of the same sensor, or too far apart; kInsufficient: they share too
///          few places.
[[nodiscard]] Result<CalibrationComparison> compare_calibrations(const Calibration& calibration,
                                                                 const Calibration& reference);

/// The same as deviations at the border of the volume, with a verdict.
[[nodiscard]] VerificationReport judge_comparison(const CalibrationComparison& comparison,
                                                  const Calibration& calibration,
                                                  const VerificationOptions& options = {});

}  // namespace flytri::calibration
