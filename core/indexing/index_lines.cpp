#include "core/indexing/index_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/median.h"

namespace flytri {
namespace {

/// The line whose unique area, grown by the margin, holds the sample. Grown areas that meet are
/// told apart by the nearer area.
std::optional<LineIndex> line_at(const PatternCalibration& pattern, const LineSample& sample,
                                 double margin) {
  std::optional<LineIndex> best;
  double best_outside = 0.0;
  for (std::size_t n = 0; n < pattern.lines.size(); ++n) {
    const LineRow& row = pattern.lines[n][static_cast<std::size_t>(sample.along_px)];
    if (!row.valid()) continue;
    const double across = sample.across_px;
    const double outside = std::max({row.area_min_px - across, across - row.area_max_px, 0.0});
    if (outside > margin * (row.area_max_px - row.area_min_px)) continue;
    if (!best || outside < best_outside) {
      best = LineIndex(n);
      best_outside = outside;
    }
  }
  return best;
}

double median_width_ratio(const PatternCalibration& pattern, const IndexedTrace& segment) {
  std::vector<double> ratios;
  for (const LineSample& sample : segment.samples) {
    const LineRow& row =
        pattern.lines[segment.line.at()][static_cast<std::size_t>(sample.along_px)];
    ratios.push_back(sample.width_px / row.width_px(sample.across_px));
  }
  return median_of(ratios);
}

/// True if the sample lies in the line's own area: then it lies in no other's.
bool is_in_area(const PatternCalibration& pattern, LineIndex line, const LineSample& sample) {
  const LineRow& row = pattern.lines[line.at()][static_cast<std::size_t>(sample.along_px)];
  return row.valid() && sample.across_px >= row.area_min_px && sample.across_px <= row.area_max_px;
}

/// Maximal runs of samples of one trace with one index; the counts take those without.
std::vector<IndexedTrace> cut(const LineTrace& trace, const PatternCalibration& pattern,
                              double margin, IndexCounts& counts) {
  std::vector<IndexedTrace> segments;
  std::optional<LineIndex> current;
  for (const LineSample& sample : trace) {
    // The neighbor's line is tried first: the others lie far away in memory.
    const auto line = current && is_in_area(pattern, *current, sample)
                          ? current
                          : line_at(pattern, sample, margin);
    if (!line) {
      ++counts.outside_areas;
    } else if (line == current) {
      segments.back().samples.push_back(sample);
    } else {
      segments.push_back({*line, {sample}});
    }
    current = line;
  }
  return segments;
}

}  // namespace

Result<void> IndexOptions::validate() const {
  if (!(area_margin >= 0.0 && area_margin <= 0.3)) {
    return fail(ErrorCode::kBadOption, "area_margin is {}, must be 0..0.3", area_margin);
  }
  if (!(max_width_ratio > 1.0)) {
    return fail(ErrorCode::kBadOption, "max_width_ratio is {}, must be > 1", max_width_ratio);
  }
  if (min_segment_length < 2) {
    return fail(ErrorCode::kBadOption, "min_segment_length is {}, must be >= 2",
                min_segment_length);
  }
  return {};
}

IndexedLines index_lines(const std::vector<LineTrace>& traces, const Calibration& calibration,
                         Pattern pattern, const IndexOptions& options) {
  const PatternCalibration& lines = calibration.of(pattern);
  IndexedLines result;
  for (const LineTrace& trace : traces) {
    for (IndexedTrace& segment : cut(trace, lines, options.area_margin, result.counts)) {
      const int count = static_cast<int>(segment.samples.size());
      if (count < options.min_segment_length) {
        result.counts.short_segments += count;
        continue;
      }
      const double ratio = median_width_ratio(lines, segment);
      if (!(ratio < options.max_width_ratio && ratio > 1.0 / options.max_width_ratio)) {
        result.counts.wrong_width += count;
        continue;
      }
      result.counts.indexed += count;
      result.traces.push_back(std::move(segment));
    }
  }
  return result;
}

}  // namespace flytri
