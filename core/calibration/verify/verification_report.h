/// @file  Result of verifying a calibration with a plane or a sphere: deviations, limits, a
///          verdict.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/record/calibration.h"
#include "core/geometry/view.h"

namespace flytri::calibration {

/// The views of the object at one pose: at rest, or three frames during slow motion.
struct VerificationPose {
  std::vector<View> views;  ///< of both patterns; at least three if it moves
  bool moves = false;       ///< the object is assumed to move at constant speed from the first to
                            ///< the last view
};

/// When a calibration is no longer valid.
struct VerificationOptions {
  /// > 0. The limit of a deviation is this factor times the residual of the calibration's fit. That
  /// residual includes the noise of single samples, so the calibration itself is more accurate.
  double residual_factor = 3.0;
  /// > 0. Added to the limit: this many standard uncertainties. At 4, chance causes about one false
  /// alarm in ten thousand.
  double noise_factor = 4.0;
  /// 0..1. Least share of the volume's width and height that was seen.
  double min_extent_share = 0.5;
  /// 0..1. Least share of the measured points that belong to the object.
  double min_share_on_object = 0.8;
  /// 0..1. Largest limit, as a share of the volume's depth. With a larger limit there is no
  /// verdict, because it could hide an error that is rejected when a calibration is fitted
  /// (CalibrateOptions::max_residual_share).
  double max_limit_share = 0.005;
  [[nodiscard]] Result<void> validate() const;
};

/// Kind of a deviation.
enum class VerificationSymptom {
  kOffset,         ///< vertical and horizontal lines measure different depths, by the same
                   ///< difference everywhere
  kOffsetInDepth,  ///< ... by a difference that depends on the depth
  kTiltAlongX,     ///< ... by a difference that changes from left to right
  kTiltAlongY,     ///< ... by a difference that changes from top to bottom
  kMagnification,  ///< ... in both directions, as if the image had another scale
  kOwnBend,        ///< the patterns measure a different curvature
  kBend,           ///< both patterns measure the same wrong curvature
  kDiameter,       ///< the measured diameter of the sphere is wrong
  kShear,          ///< planes at other depths are shifted sideways
  kScale,          ///< distances are wrong by the same share everywhere
  kForm,           ///< points scatter more than expected from noise
};

/// One deviation and its limit, at the border of the volume, where it is largest.
struct VerificationFigure {
  VerificationSymptom symptom = VerificationSymptom::kOffset;
  std::string name;
  double deviation_mm = 0.0;
  double uncertainty_mm = 0.0;  ///< standard uncertainty, from the scatter of the lines; 0: not
                                ///< known
  double limit_mm = 0.0;
  [[nodiscard]] bool good() const { return std::abs(deviation_mm) <= limit_mm; }
};

/// kUnclear: the data allow no verdict; the report gives the reason.
enum class VerificationOutcome { kValid, kBroken, kUnclear };
[[nodiscard]] std::string_view to_string(VerificationOutcome outcome);

struct VerificationReport {
  VerificationOutcome outcome = VerificationOutcome::kUnclear;
  std::vector<VerificationFigure> figures;
  std::string reason;                 ///< why the outcome is unclear
  std::vector<std::string> meanings;  ///< if it is no longer valid: what has probably happened to
                                      ///< the sensor
};

/// Sets the outcome from the figures: broken if one exceeds its limit, unclear if one is too
/// uncertain.
void judge(VerificationReport& report, const MeasurementVolume& volume,
           const VerificationOptions& options);

}  // namespace flytri::calibration
