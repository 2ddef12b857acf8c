/// @file  Cuts traces at jumps and takes away their ends, where the blur of the optics mixes the
/// line with what lies beside it.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/localization/line_trace.h"

namespace flytri::localization {

/// What is left of a trace.
struct TrimOptions {
  /// 0..5. Samples taken from each end of a segment, in widths (FWHM) of the line: the image is as
  /// blurred along the line as across it, and within a blur of the end the light comes from one
  /// side only.
  double end_widths = 1.0;
  /// 0..1. After that the end goes on as long as its amplitude is below this share of the amplitude
  /// one width farther inside: a surface that turns away, or light that fades.
  double min_end_amplitude = 0.7;
  /// > 0. A step between neighboring rows that exceeds the local slope by this many widths is a
  /// depth step: the line breaks there even if the peaks were linked.
  double max_step_widths = 0.3;
  int min_length = 8;  ///< >= 3. Shorter segments, or such below 3 widths, are no lines but blots.

  [[nodiscard]] Result<void> validate() const;
};

/// @param along_count  rows of the image: at its border a line is cut off, but not mixed.
[[nodiscard]] std::vector<LineTrace> trim_traces(const std::vector<LineTrace>& traces,
                                                 int along_count, const TrimOptions& options);

}  // namespace flytri::localization
