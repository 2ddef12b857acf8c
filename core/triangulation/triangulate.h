/// @file  From indexed line samples to line profiles in millimeters.
#pragma once

#include "core/geometry/view.h"
#include "core/indexing/index_lines.h"

namespace flytri::triangulation {

/// Where traces are cut into profiles.
struct TriangulateOptions {
  /// >= 1. Number of consecutive rows that may be missing within a profile.
  int max_gap_px = 2;
  /// > 0. A jump between neighboring rows by more than this, plus the expected noise, is a depth
  /// step: the two sides are not neighbors on the surface.
  double max_jump_px = 2.5;
  /// >= 2. Shorter profiles are dropped.
  int min_profile_length = 4;

  [[nodiscard]] Result<void> validate() const;
};

/// A view (frame and time are not set) and the number of lost samples.
struct Triangulation {
  View view;
  int short_profiles = 0;  ///< samples in parts that are too short for a profile
};

/// Computes positions from the calibration. A point's deviation is the uncertainty of the sample
/// times the derivative of the position along the row or column.
/// @source  Arold et al., "z-Calibration" (depth polynomial of a line) and "xy-Calibration"
///          (polynomials for x and y).
[[nodiscard]] Triangulation triangulate(const indexing::IndexedLines& lines,
                                        const calibration::Calibration& calibration,
                                        Pattern pattern, const TriangulateOptions& options);

}  // namespace flytri::triangulation
