#include "core/indexing/depth_steps.h"

#include <algorithm>
#include <cmath>

namespace flytri::indexing {
namespace {

using localization::LineSample;
using localization::LineTrace;

/// Samples on each side of a step that are compared, and those in between that are left out, since
/// the localization smooths the width over about 20 rows.
constexpr std::size_t kSide = 12, kBetween = 4;
/// A larger relative change of the width is a step. A surface that turns by 30 degrees changes the
/// width by 0.07.
constexpr double kMaxWidthChange = 0.12;
/// A larger offset between both sides is a step, in line widths.
constexpr double kMaxOffset = 0.25;

/// Straight line through the samples of one side, and their mean logarithm of the width.
struct Side {
  double across_px = 0.0;  ///< where the straight line crosses the row of the step
  double log_width = 0.0;
};

Side side_of(const LineTrace& trace, const std::vector<double>& log_widths, std::size_t begin,
             std::size_t end, double row) {
  double n = 0, t1 = 0, t2 = 0, x = 0, tx = 0, w = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const double t = trace[i].along_px - row;
    n += 1, t1 += t, t2 += t * t;
    x += trace[i].across_px, tx += t * trace[i].across_px;
    w += log_widths[i];
  }
  return {(t2 * x - t1 * tx) / (n * t2 - t1 * t1), w / n};
}

/// How clear the step between samples i - 1 and i is; above 1: cut there.
double step_at(const LineTrace& trace, const std::vector<double>& log_widths, std::size_t i) {
  const double row = 0.5 * (trace[i - 1].along_px + trace[i].along_px);
  const std::size_t before = i - std::min(i, kBetween / 2);
  const std::size_t after = std::min(i + kBetween / 2, trace.size());
  const Side left = side_of(trace, log_widths, before - std::min(before, kSide), before, row);
  const Side right = side_of(trace, log_widths, after, std::min(after + kSide, trace.size()), row);
  const double offset = std::abs(right.across_px - left.across_px) / trace[i].width_px;
  return std::max(std::abs(right.log_width - left.log_width) / kMaxWidthChange,
                  offset / kMaxOffset);
}

/// The places of the steps: the clearest one of each neighborhood.
std::vector<std::size_t> steps_of(const LineTrace& trace) {
  constexpr std::size_t kLeast = kSide / 2 + kBetween;  // for a straight line on both sides
  std::vector<double> log_widths;
  log_widths.reserve(trace.size());
  for (const LineSample& sample : trace) log_widths.push_back(std::log(sample.width_px));
  std::vector<std::size_t> steps;
  double last = 0.0;
  for (std::size_t i = kLeast; i + kLeast < trace.size(); ++i) {
    const double step = step_at(trace, log_widths, i);
    if (step <= 1.0) continue;
    if (!steps.empty() && i - steps.back() < kSide) {
      if (step <= last) continue;
      steps.pop_back();
    }
    steps.push_back(i);
    last = step;
  }
  return steps;
}

}  // namespace

std::vector<TracePart> cut_at_depth_steps(const std::vector<LineTrace>& traces) {
  std::vector<TracePart> parts;
  for (const LineTrace& trace : traces) {
    std::vector<std::size_t> ends = steps_of(trace);
    ends.push_back(trace.size());
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
      const auto first = trace.begin() + static_cast<std::ptrdiff_t>(begin);
      parts.push_back(
          {LineTrace(first, trace.begin() + static_cast<std::ptrdiff_t>(end)), begin > 0});
      begin = end;
    }
  }
  return parts;
}

}  // namespace flytri::indexing
