/// @file  Cuts traces at depth steps and removes their ends, where blur mixes the line with its
///          surroundings.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/localization/line_trace.h"

namespace flytri::localization {

/// How much of a trace is removed.
struct TrimOptions {
  /// 0..5. Samples removed from each end of a segment, in widths (FWHM) of the line. The image is
  /// blurred along the line too, and near the end the light comes from one side only.
  double end_widths = 1.0;
  /// 0..1. Then more samples are removed as long as the amplitude is below this share of the
  /// amplitude one width farther inside: the surface turns away or the light fades.
  double min_end_amplitude = 0.7;
  /// > 0. A step between neighboring rows that differs from the local slope by more than this many
  /// widths is a depth step: the trace is cut there.
  double max_step_widths = 0.3;
  int min_length = 8;  ///< >= 3. Segments that are shorter than this or than 3 widths are spots,
                       ///< not lines.

  [[nodiscard]] Result<void> validate() const;
};

/// @param along_count  rows of the image. No samples are removed at its border, where the line is
///                     cut off but not mixed.
[[nodiscard]] std::vector<LineTrace> trim_traces(const std::vector<LineTrace>& traces,
                                                 int along_count, const TrimOptions& options);

}  // namespace flytri::localization
