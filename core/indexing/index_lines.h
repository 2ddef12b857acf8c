/// @file  Gives localized lines their index n and rejects samples outside the measurement volume.
#pragma once

#include <vector>

#include "core/calibration/record/calibration.h"
#include "core/indexing/agree_on_lines.h"
#include "core/localization/line_trace.h"

namespace flytri::indexing {

/// When a sample keeps its line index.
struct IndexOptions {
  /// 0..0.3. Each side of a unique area is enlarged by this share of its width, but never into a
  /// neighboring area.
  double area_margin = 0.02;
  /// > 1. The median normalized width of a segment must lie between 1 / this and this. A surface
  /// tilted by 65 degrees widens a line this much at a triangulation angle of 7 degrees; in front
  /// of or behind the volume the width is wrong by a factor of 1.3 to 2.
  double max_width_ratio = 1.28;
  /// >= max_width_ratio. The same limit within a segment, over one line width: at a depth step a
  /// line may continue as another line that is far away and blurred. Larger than the widening at a
  /// steep flank, which should be kept.
  double max_local_width_ratio = 1.6;
  /// >= 2. Segments with fewer samples have no reliable width.
  int min_segment_length = 6;
  /// Where unique areas overlap: when the number of a line is certain.
  AgreeOptions agree{};

  [[nodiscard]] Result<void> validate() const;
};

/// Number of samples by result.
struct IndexCounts {
  int indexed = 0;
  int outside_areas = 0;   ///< in no unique area: outside the volume
  int wrong_width = 0;     ///< wrong normalized width of the segment or of a part of it: outside
                           ///< the volume
  int short_segments = 0;  ///< too few connected samples with one index
  int ambiguous = 0;       ///< dense lines: several indexes are about as likely

  [[nodiscard]] int total() const {
    return indexed + outside_areas + wrong_width + short_segments + ambiguous;
  }
};

/// Connected samples of one line.
struct IndexedTrace {
  LineIndex line;
  localization::LineTrace samples;
};

struct IndexedLines {
  std::vector<IndexedTrace> traces;  ///< in the order of the input traces
  IndexCounts counts;
};

/// Cuts each trace where it leaves a unique area, and checks the normalized width of each segment.
/// Where areas overlap, agree_on_lines() chooses among the lines that can be at a place.
/// @source  Arold et al., "Line Indexing"; here the width is checked per segment, because the noise
///          of a single width is as large as the difference to detect.
[[nodiscard]] IndexedLines index_lines(const std::vector<localization::LineTrace>& traces,
                                       const calibration::Calibration& calibration, Pattern pattern,
                                       const IndexOptions& options);

}  // namespace flytri::indexing
