/// @file  Links the peaks of neighboring rows to traces along the lines.
#pragma once

#include <vector>

#include "core/localization/find_peaks.h"

namespace flytri::localization {

/// The peaks of one line by rising row.
using PeakTrace = std::vector<Peak>;

/// Adds each peak to the trace whose expected position is nearest; trace and peak must be each
/// other's nearest. A few rows may be missing in a trace.
/// @param max_slope  largest slope of a line, pixels across per pixel along.
[[nodiscard]] std::vector<PeakTrace> link_traces(const PeakRows& peaks, double max_slope,
                                                 int min_length);

}  // namespace flytri::localization
