/// @file  Numbers the lines on the white planes of a calibration set.
#pragma once

#include <vector>

#include "core/base/workers.h"
#include "core/calibration/record/calibration_set.h"
#include "core/localization/localize.h"

namespace flytri::calibration {

/// The samples of one line on one plane.
struct LineOnPlane {
  std::size_t plane = 0;  ///< number of the plane in its set
  std::vector<localization::LineSample> samples;
  std::vector<double> z_mm;  ///< depth of each sample
};

/// By line n: the planes on which the line was seen, by rising number.
using NumberedLines = std::vector<std::vector<LineOnPlane>>;

/// Localizes the lines of `pattern` on every plane and numbers them.
///
/// All lines must be in the image of the plane nearest to z = 0, where they are numbered in order.
/// From there, numbers are followed from plane to plane in both directions: each line gets the
/// number of the nearest predicted position. Lines may leave the image.
/// @errors  kInconsistent or kInsufficient, naming the image.
[[nodiscard]] Result<NumberedLines> number_lines(const CalibrationSet& set, Pattern pattern,
                                                 const localization::LocalizeOptions& options,
                                                 const Workers& workers);

}  // namespace flytri::calibration
