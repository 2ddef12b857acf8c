#include "core/indexing/index_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/check_options.h"
#include "core/base/median.h"

namespace flytri::indexing {
namespace {

/// The line whose unique area, enlarged by the margin, contains the sample. If two enlarged areas
/// contain it, the nearer area is taken.
std::optional<LineIndex> line_at(const calibration::PatternCalibration& pattern,
                                 const localization::LineSample& sample, double margin) {
  std::optional<LineIndex> best;
  double best_outside = 0.0;
  for (std::size_t n = 0; n < pattern.lines.size(); ++n) {
    const calibration::LineRow& row = pattern.lines[n][static_cast<std::size_t>(sample.along_px)];
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

/// Normalized width: width of each sample divided by the calibrated width of its line there.
std::vector<double> width_ratios(const calibration::PatternCalibration& pattern,
                                 const IndexedTrace& segment) {
  std::vector<double> ratios;
  ratios.reserve(segment.samples.size());
  for (const localization::LineSample& sample : segment.samples) {
    const calibration::LineRow& row =
        pattern.lines[segment.line.at()][static_cast<std::size_t>(sample.along_px)];
    ratios.push_back(sample.width_px / row.width_px(sample.across_px));
  }
  return ratios;
}

bool is_within(double ratio, double limit) { return ratio < limit && ratio > 1.0 / limit; }

/// Marks samples that belong to another line. Around each marked sample, within one line width,
/// most widths are wrong; samples one line width beyond are marked too, because the blur mixes both
/// lines there.
std::vector<bool> find_foreign(const localization::LineTrace& samples,
                               const std::vector<double>& ratios, double limit) {
  const std::size_t size = samples.size();
  std::vector<bool> foreign(size, false);
  std::vector<std::size_t> off_before(size + 1, 0);  // number of samples with a wrong width before
                                                     // each
  for (std::size_t i = 0; i < size; ++i) {
    off_before[i + 1] = off_before[i] + (is_within(ratios[i], limit) ? 0U : 1U);
  }
  if (off_before.back() == 0) return foreign;
  std::size_t done = 0;  // everything before is marked
  for (std::size_t i = 0; i < size; ++i) {
    const auto reach = static_cast<std::size_t>(std::ceil(samples[i].width_px / ratios[i]));
    const std::size_t begin = i > reach ? i - reach : 0, end = std::min(i + reach + 1, size);
    if (2 * (off_before[end] - off_before[begin]) <= end - begin) continue;
    for (done = std::max(done, begin); done < end; ++done) foreign[done] = true;
  }
  return foreign;
}

/// The unmarked samples of a segment, as connected pieces.
std::vector<IndexedTrace> without(const IndexedTrace& segment, const std::vector<bool>& marked) {
  std::vector<IndexedTrace> pieces;
  for (std::size_t i = 0; i < segment.samples.size(); ++i) {
    if (marked[i]) continue;
    if (i == 0 || marked[i - 1]) pieces.push_back({segment.line, {}});
    pieces.back().samples.push_back(segment.samples[i]);
  }
  return pieces;
}

/// True if the sample lies in the line's own area, enlarged by the margin.
bool is_in_area(const calibration::PatternCalibration& pattern, LineIndex line,
                const localization::LineSample& sample, double margin) {
  const calibration::LineRow& row =
      pattern.lines[line.at()][static_cast<std::size_t>(sample.along_px)];
  const double reach = margin * (row.area_max_px - row.area_min_px);
  return row.valid() && sample.across_px >= row.area_min_px - reach &&
         sample.across_px <= row.area_max_px + reach;
}

/// Cuts a trace into the longest runs with one line index. Samples without an index are counted.
std::vector<IndexedTrace> cut(const localization::LineTrace& trace,
                              const calibration::PatternCalibration& pattern, double margin,
                              IndexCounts& counts) {
  std::vector<IndexedTrace> segments;
  std::optional<LineIndex> current;
  for (const localization::LineSample& sample : trace) {
    // The line of the previous sample is tried first: the other lines are far away in memory.
    const auto line = current && is_in_area(pattern, *current, sample, 0.0)
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

/// The parts of all traces on whose lines the image agrees. Samples of the others, and those
/// outside the area of their line, are counted.
std::vector<IndexedTrace> cut_dense(const std::vector<localization::LineTrace>& traces,
                                    const calibration::Calibration& calibration, Pattern pattern,
                                    const IndexOptions& options, IndexCounts& counts) {
  const std::vector<TracePart> parts = cut_at_depth_steps(traces);
  const auto lines = agree_on_lines(collect_evidence(parts, calibration, pattern), options.agree);
  std::vector<IndexedTrace> segments;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const localization::LineTrace& samples = parts[p].samples;
    if (!lines[p]) {
      counts.ambiguous += static_cast<int>(samples.size());
      continue;
    }
    bool is_open = false;
    for (const localization::LineSample& sample : samples) {
      const bool is_inside =
          is_in_area(calibration.of(pattern), *lines[p], sample, options.area_margin);
      if (is_inside) {
        if (!is_open) segments.push_back({*lines[p], {}});
        segments.back().samples.push_back(sample);
      } else {
        ++counts.outside_areas;
      }
      is_open = is_inside;
    }
  }
  return segments;
}

}  // namespace

Result<void> IndexOptions::validate() const {
  return OptionCheck("IndexOptions")
      .in_range("area_margin", area_margin, 0.0, 0.3)
      .above("max_width_ratio", max_width_ratio, 1.0)
      .must("max_local_width_ratio", max_local_width_ratio,
            max_local_width_ratio >= max_width_ratio, "at least max_width_ratio")
      .at_least("min_segment_length", min_segment_length, 2)
      .nested(agree)
      .result();
}

IndexedLines index_lines(const std::vector<localization::LineTrace>& traces,
                         const calibration::Calibration& calibration, Pattern pattern,
                         const IndexOptions& options) {
  const calibration::PatternCalibration& lines = calibration.of(pattern);
  IndexedLines result;
  const auto judge = [&](const IndexedTrace& segment) {
    const int count = static_cast<int>(segment.samples.size());
    if (count < options.min_segment_length) {
      result.counts.short_segments += count;
      return;
    }
    const std::vector<double> ratios = width_ratios(lines, segment);
    result.counts.wrong_width += count;
    std::vector<double> reordered = ratios;
    if (!is_within(median_of(reordered), options.max_width_ratio)) return;
    const auto foreign = find_foreign(segment.samples, ratios, options.max_local_width_ratio);
    for (IndexedTrace& piece : without(segment, foreign)) {
      const int kept = static_cast<int>(piece.samples.size());
      result.counts.wrong_width -= kept;
      if (kept < options.min_segment_length) {
        result.counts.short_segments += kept;
        continue;
      }
      result.counts.indexed += kept;
      result.traces.push_back(std::move(piece));
    }
  };
  if (lines.has_shared_areas()) {
    for (const IndexedTrace& segment :
         cut_dense(traces, calibration, pattern, options, result.counts))
      judge(segment);
    return result;
  }
  for (const localization::LineTrace& trace : traces) {
    for (const IndexedTrace& segment : cut(trace, lines, options.area_margin, result.counts)) {
      judge(segment);
    }
  }
  return result;
}

}  // namespace flytri::indexing
