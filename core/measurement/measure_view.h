/// @file  From a measurement frame to a view: localization, indexing and triangulation in a row.
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
  /// > 1. Of an unknown frame, one pattern must explain this many times more than the other.
  double min_pattern_ratio = 3.0;
  /// >= 1. A view with fewer points shows nothing that could be aligned.
  int min_points = 50;

  [[nodiscard]] Result<void> validate() const;
};

enum class MeasureOutcome {
  kMeasured,
  kTooFewPoints,      ///< nothing, or next to nothing, inside the volume
  kAmbiguousPattern,  ///< an unknown frame that both patterns explain alike
};
[[nodiscard]] std::string_view to_string(MeasureOutcome outcome);

/// Samples of one frame, and where they went. localized = index.total(), and
/// index.indexed = points + short_profiles.
struct MeasureCounts {
  int localized = 0;
  indexing::IndexCounts index;
  int short_profiles = 0;
  int points = 0;
};

/// What became of a frame. The view is empty of profiles unless the outcome is kMeasured.
struct MeasuredView {
  MeasureOutcome outcome = MeasureOutcome::kMeasured;
  View view;
  MeasureCounts counts;
  /// Where lines were localized, one list a trace, whether or not points came of them.
  std::vector<std::vector<Pixel>> lines;
};

/// Measures one frame; of an unknown frame the pattern is told from the image: lines of the other
/// pattern do not run along their unique areas, so the right one gives far more points.
/// @errors  kBadOption for options or a texture frame, kInconsistent if the image has not the size
///          of the calibration, kBadFormat for another type of image.
[[nodiscard]] Result<MeasuredView> measure_view(const Frame& frame,
                                                const calibration::Calibration& calibration,
                                                const MeasureOptions& options);

}  // namespace flytri::measurement
