/// @file  What a look at a plane or a sphere says of a calibration: deviations, limits, a verdict.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/record/calibration.h"
#include "core/geometry/view.h"

namespace flytri::calibration {

/// What the sensor saw of the object while it rested, or in three frames while it moved slowly.
struct VerificationPose {
  std::vector<View> views;  ///< of both patterns; at least three where it moves
  bool moves = false;       ///< the object's motion is taken to be even from first to last view
};

/// When a calibration is said to hold no longer.
struct VerificationOptions {
  /// > 0. A deviation counts beyond so many times what the calibration's fit left. That residual
  /// is of single samples, noise and all: what is wrong with the calibration itself is less.
  double residual_factor = 3.0;
  /// > 0. ... and so many standard uncertainties more: at 4, chance alone gives one false alarm in
  /// ten thousand.
  double noise_factor = 4.0;
  /// 0..1. Share of the volume's width and height that must have been seen.
  double min_extent_share = 0.5;
  /// 0..1. Share of what was measured that must belong to the object.
  double min_share_on_object = 0.8;
  /// 0..1. A limit beyond this share of the volume's depth gives no verdict: what a calibration is
  /// refused for when it is fitted (CalibrateOptions::max_residual_share) could hide within it.
  double max_limit_share = 0.005;
  [[nodiscard]] Result<void> validate() const;
};

/// What a deviation points to.
enum class VerificationSymptom {
  kOffset,         ///< vertical and horizontal lines disagree everywhere alike
  kOffsetInDepth,  ///< ... the more, the nearer or farther
  kTiltAlongX,     ///< ... from left to right
  kTiltAlongY,     ///< ... from top to bottom
  kMagnification,  ///< ... both ways, as if the image had another scale
  kOwnBend,        ///< one pattern bends against the other
  kBend,           ///< both bend alike
  kDiameter,       ///< the sphere has another size
  kForm,           ///< what is left scatters more than noise explains
};

/// One deviation, at the border of the volume, where it is largest.
struct VerificationFigure {
  VerificationSymptom symptom = VerificationSymptom::kOffset;
  std::string name;
  double deviation_mm = 0.0;
  double uncertainty_mm = 0.0;  ///< standard, from the scatter of the lines; 0: not known
  double limit_mm = 0.0;
  [[nodiscard]] bool good() const { return std::abs(deviation_mm) <= limit_mm; }
};

/// kUnclear: what was seen allows no verdict; the reason says why.
enum class VerificationOutcome { kValid, kBroken, kUnclear };
[[nodiscard]] std::string_view to_string(VerificationOutcome outcome);

struct VerificationReport {
  VerificationOutcome outcome = VerificationOutcome::kUnclear;
  std::vector<VerificationFigure> figures;
  std::string reason;                 ///< of an unclear outcome
  std::vector<std::string> meanings;  ///< of a broken one: what must have happened to the sensor
};

/// Judges the figures: unclear if one is not known well enough, broken if one is beyond its limit.
void judge(VerificationReport& report, const MeasurementVolume& volume,
           const VerificationOptions& options);

}  // namespace flytri::calibration
