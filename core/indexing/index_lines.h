/// @file  Gives localized lines their index n, and throws out what left the measurement volume.
#pragma once

#include <vector>

#include "core/calibration/record/calibration.h"
#include "core/localization/line_trace.h"

namespace flytri::indexing {

/// When a sample keeps its label.
struct IndexOptions {
  /// 0..0.3. Share of a unique area that each side is grown by, but never into a neighbor's.
  double area_margin = 0.02;
  /// > 1. The median normalized width of a segment must lie between 1 / this and this. A surface
  /// tilted by 65 degrees widens a line this much at a triangulation angle of 7 degrees; a line
  /// from before or behind the volume is off by a factor of 1.3 to 2.
  double max_width_ratio = 1.28;
  /// >= max_width_ratio. The same within a segment, for stretches as long as the line is wide: at a
  /// depth step a line may go on as another one, far away and blurred. Beyond what a single steep
  /// flank does, which is no reason to lose it.
  double max_local_width_ratio = 1.6;
  /// >= 2. Segments with fewer samples have no reliable width.
  int min_segment_length = 6;

  [[nodiscard]] Result<void> validate() const;
};

/// Where samples went.
struct IndexCounts {
  int indexed = 0;
  int outside_areas = 0;   ///< in no unique area: surely outside the volume
  int wrong_width = 0;     ///< normalized width of segment or stretch is off: outside the volume
  int short_segments = 0;  ///< too few connected samples with one index

  [[nodiscard]] int total() const { return indexed + outside_areas + wrong_width + short_segments; }
};

/// Connected samples of one line.
struct IndexedTrace {
  LineIndex line;
  localization::LineTrace samples;
};

struct IndexedLines {
  std::vector<IndexedTrace> traces;  ///< in the order of the traces they come from
  IndexCounts counts;
};

/// Cuts each trace where it leaves a unique area, and judges every segment by its normalized width.
/// @source  Arold et al., "Line Indexing"; the width is judged segment by segment because a single
///          width is as noisy as the difference that it must tell.
[[nodiscard]] IndexedLines index_lines(const std::vector<localization::LineTrace>& traces,
                                       const calibration::Calibration& calibration, Pattern pattern,
                                       const IndexOptions& options);

}  // namespace flytri::indexing
