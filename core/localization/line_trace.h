/// @file  Sub-pixel samples of projected lines, linked along each line: the result of the
///          localization.
#pragma once

#include <vector>

namespace flytri::localization {

/// Where a line crosses one image row (vertical pattern) or column (horizontal pattern).
struct LineSample {
  int along_px = 0;        ///< the row or column
  float across_px = 0;     ///< sub-pixel position in that row or column
  float width_px = 0;      ///< full width at half maximum, corrected for the smoothing
  float amplitude = 0;     ///< height above the local background, gray values of the image
  float sigma_px = 0;      ///< standard uncertainty of across_px
  bool saturated = false;  ///< the peak is clipped: the position comes from the flanks
};

/// Connected samples by rising along_px. One line may give several traces.
using LineTrace = std::vector<LineSample>;

}  // namespace flytri::localization
