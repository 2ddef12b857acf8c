/// @file  Links the peaks of neighboring rows to traces along the lines.
#pragma once

#include <vector>

#include "core/localization/find_peaks.h"

namespace flytri::localization {

/// The peaks of one line by rising row.
using PeakTrace = std::vector<Peak>;

/// Joins each peak to the trace whose continuation it is nearest to; both must be each other's
/// nearest. A trace may miss a row and go on.
/// @param max_slope  steepest line that is followed, pixels across per pixel along.
[[nodiscard]] std::vector<PeakTrace> link_traces(const PeakRows& peaks, double max_slope,
                                                 int min_length);

}  // namespace flytri::localization
