/// @file  From a measurement frame to a view: runs localization, indexing and triangulation.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/view.h"
#include "core/imaging/frame.h"
#include "core/indexing/index_lines.h"
#include "core/localization/localize.h"
#include "core/triangulation/triangulate.h"

namespace flytri::measurement {

struct MeasureOptions {
  localization::LocalizeOptions localize;
  indexing::IndexOptions index;
  triangulation::TriangulateOptions triangulate;
  /// > 1. For a frame of unknown pattern: one pattern must give this many times more points than
  /// the other.
  double min_pattern_ratio = 3.0;
  /// >= 1. A view with fewer points cannot be aligned.
  int min_points = 50;

  [[nodiscard]] Result<void> validate() const;
};

enum class MeasureOutcome {
  kMeasured,
  kTooFewPoints,      ///< nothing or almost nothing inside the volume
  kAmbiguousPattern,  ///< a frame of unknown pattern for which both patterns give many points
};
[[nodiscard]] std::string_view to_string(MeasureOutcome outcome);

/// Number of samples of one frame after each step. localized = index.total(), and index.indexed =
/// points + short_profiles.
struct MeasureCounts {
  int localized = 0;
  indexing::IndexCounts index;
  int short_profiles = 0;
  int points = 0;
};

/// Result for one frame. The view has profiles only if the outcome is kMeasured.
struct MeasuredView {
  MeasureOutcome outcome = MeasureOutcome::kMeasured;
  View view;
  MeasureCounts counts;
  /// Where lines were localized, one list per trace, including lines that gave no points.
  std::vector<std::vector<Pixel>> lines;
};

/// Measures one frame. If the pattern is unknown, both are tried: lines of the wrong pattern do not
/// run along their unique areas, so the right pattern gives far more points.
/// @errors  kBadOption for options or a texture frame, kInconsistent if the size of the image
///          differs from that of the calibration, kBadFormat for another type of image.
[[nodiscard]] Result<MeasuredView> measure_view(const Frame& frame,
                                                const calibration::Calibration& calibration,
                                                const MeasureOptions& options);

}  // namespace flytri::measurement
