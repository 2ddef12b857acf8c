/// @file  Which line is which on the white planes of a calibration set.
#pragma once

#include <vector>

#include "core/base/workers.h"
#include "core/calibration/record/calibration_set.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

/// The samples of one line on one plane.
struct LineOnPlane {
  double z_mm = 0.0;
  std::vector<localization::LineSample> samples;  ///< by rising along_px
};

/// By line n, then by rising z: the planes on which the line was seen.
using NumberedLines = std::vector<std::vector<LineOnPlane>>;

/// Localizes the lines of `pattern` on every plane and numbers them.
///
/// On the plane nearest z = 0 all lines are in the image and are numbered in order. From there the
/// numbers are carried from plane to plane, up and down, each line to the nearest one to where its
/// motion so far predicts it. Lines may leave the image.
/// @errors  kInconsistent or kInsufficient, naming the image.
[[nodiscard]] Result<NumberedLines> number_lines(const CalibrationSet& set, Pattern pattern,
                                                 const localization::LocalizeOptions& options,
                                                 const Workers& workers);

}  // namespace flytri::calibration
