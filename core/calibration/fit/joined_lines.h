/// @file  Joins the traces of each line on a plane.
#pragma once

#include <vector>

#include "core/localization/line_trace.h"

namespace flytri::calibration {

/// All samples of one line on one plane, and its position in the middle of the image.
struct JoinedLine {
  double middle_px = 0.0;
  localization::LineTrace samples;  ///< by rising along_px
};

/// The lines of one plane by rising position; short traces are ignored.
/// @param along_count  rows (vertical pattern) or columns (horizontal) of the image
[[nodiscard]] std::vector<JoinedLine> joined_lines_of(
    const std::vector<localization::LineTrace>& traces, int along_count);

/// Median distance between neighboring lines; 0 for fewer than two.
[[nodiscard]] double median_gap_px(const std::vector<JoinedLine>& joined_lines);

}  // namespace flytri::calibration
