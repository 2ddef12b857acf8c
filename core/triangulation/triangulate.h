/// @file  From indexed line samples to line profiles in millimetres.
#pragma once

#include "core/geometry/view.h"
#include "core/indexing/index_lines.h"

namespace flytri::triangulation {

/// Where a trace is cut into profiles.
struct TriangulateOptions {
  /// >= 1. Rows that a profile may miss and still be connected.
  int max_gap_px = 2;
  /// > 0. A jump between neighboring rows, beyond this many px and beyond what noise explains, is
  /// a depth step: the two sides are not neighbors on the surface.
  double max_jump_px = 2.5;
  /// >= 2. Shorter profiles are dropped.
  int min_profile_length = 4;

  [[nodiscard]] Result<void> validate() const;
};

/// A view without frame and time, and how many samples it lost.
struct Triangulation {
  View view;
  int short_profiles = 0;  ///< samples in pieces too short for a profile
};

/// Looks positions up in the calibration; the deviation is the sample's uncertainty times the
/// derivative of the position along the row or column.
/// @source  Arold et al., equations (e_calib_z), (polynom_x), (polynom_y).
[[nodiscard]] Triangulation triangulate(const indexing::IndexedLines& lines,
                                        const calibration::Calibration& calibration,
                                        Pattern pattern, const TriangulateOptions& options);

}  // namespace flytri::triangulation
