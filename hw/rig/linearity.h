/// @file  Judges from exposure steps whether a camera's gray values are proportional to the light.
#pragma once

#include <vector>

#include "core/base/result.h"

namespace flytri::rig {

/// The mean gray value of one place, at one exposure.
struct ExposureStep {
  double exposure_s = 0.0;  ///< > 0
  double gray = 0.0;        ///< 0..1 of full scale
};

struct Linearity {
  double black = 0.0;      ///< gray value without light, by the straight line
  double gamma = 1.0;      ///< gray - black is proportional to exposure^gamma; 1: linear
  double deviation = 0.0;  ///< largest distance from the straight line, of the range of gray values
  bool is_linear = false;
};

/// Fits a straight line, and a power for the message. Steps above 0.95 of full scale are left out.
/// @errors  kBadOption: less than four steps are left, or they span less than a factor of two in
///          exposure or a fifth of full scale; the message says what to change
[[nodiscard]] Result<Linearity> judge_linearity(const std::vector<ExposureStep>& steps);

}  // namespace flytri::rig
