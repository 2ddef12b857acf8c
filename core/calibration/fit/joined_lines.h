/// @file  The lines on a plane, numbered or not yet: pieces that belong together are joined.
#pragma once

#include <vector>

#include "core/localization/line_trace.h"

namespace flytri::calibration {

/// All pieces of one line on one plane, and where it crosses the middle of the image.
struct JoinedLine {
  double middle_px = 0.0;
  localization::LineTrace samples;  ///< by rising along_px
};

/// The lines of one plane by rising position; pieces too short for a line are left out.
/// @param along_count  rows (vertical pattern) or columns (horizontal) of the image
[[nodiscard]] std::vector<JoinedLine> joined_lines_of(
    const std::vector<localization::LineTrace>& traces, int along_count);

/// Median distance between neighbors; 0 for less than two.
[[nodiscard]] double median_gap_px(const std::vector<JoinedLine>& joined_lines);

}  // namespace flytri::calibration
