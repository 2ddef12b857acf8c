#include "core/calibration/fit/joined_lines.h"

#include <algorithm>

#include "core/base/median.h"

namespace flytri::calibration {
namespace {

/// Least length of a trace, as a share of the image: dirt causes shorter traces.
constexpr double kMinShare = 0.1;
/// Traces of one line cross the middle of the image within this distance.
constexpr double kSameLine = 0.3;  // share of the line spacing

/// Where the straight line through the samples crosses row `along`.
double crossing(const localization::LineTrace& samples, double along) {
  double n = 0, sum_t = 0, sum_x = 0, sum_tt = 0, sum_tx = 0;
  for (const localization::LineSample& sample : samples) {
    const double t = sample.along_px - along;
    n += 1;
    sum_t += t;
    sum_x += sample.across_px;
    sum_tt += t * t;
    sum_tx += t * sample.across_px;
  }
  return (sum_tt * sum_x - sum_t * sum_tx) / (n * sum_tt - sum_t * sum_t);
}

}  // namespace

double median_gap_px(const std::vector<JoinedLine>& joined_lines) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < joined_lines.size(); ++i) {
    gaps.push_back(joined_lines[i].middle_px - joined_lines[i - 1].middle_px);
  }
  return gaps.empty() ? 0.0 : median_of(gaps);
}

std::vector<JoinedLine> joined_lines_of(const std::vector<localization::LineTrace>& traces,
                                        int along_count) {
  std::vector<JoinedLine> pieces, whole;
  for (const localization::LineTrace& trace : traces) {
    if (static_cast<double>(trace.size()) < kMinShare * along_count) continue;
    pieces.push_back({crossing(trace, 0.5 * along_count), trace});
    if (static_cast<double>(trace.size()) > 0.5 * along_count) whole.push_back(pieces.back());
  }
  const auto by_position = [](const JoinedLine& a, const JoinedLine& b) {
    return a.middle_px < b.middle_px;
  };
  std::stable_sort(pieces.begin(), pieces.end(), by_position);
  std::stable_sort(whole.begin(), whole.end(), by_position);
  const double joinable_px = kSameLine * median_gap_px(whole);

  std::vector<JoinedLine> joined_lines;
  for (JoinedLine& piece : pieces) {
    if (!joined_lines.empty() && piece.middle_px - joined_lines.back().middle_px < joinable_px) {
      localization::LineTrace& samples = joined_lines.back().samples;
      samples.insert(samples.end(), piece.samples.begin(), piece.samples.end());
    } else {
      joined_lines.push_back(std::move(piece));
    }
  }
  for (JoinedLine& joined_line : joined_lines) {
    std::stable_sort(joined_line.samples.begin(), joined_line.samples.end(),
                     [](const localization::LineSample& a, const localization::LineSample& b) {
                       return a.along_px < b.along_px;
                     });
  }
  return joined_lines;
}

}  // namespace flytri::calibration
