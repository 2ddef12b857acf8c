#include "core/localization/trim_traces.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "core/base/check_options.h"

namespace flytri::localization {
namespace {

/// A segment must be this many times longer than wide; otherwise it is a spot of light, not a line.
constexpr float kMinLengthWidths = 3.0F;

/// True if the line breaks between two neighbors: a step that neither the slope before nor the
/// slope after explains.
bool breaks(const LineTrace& trace, std::size_t i, double max_step_widths) {
  constexpr std::size_t kReach = 4;  // samples used for a slope
  const LineSample &a = trace[i - 1], &b = trace[i];
  const auto slope = [&](const LineSample& from, const LineSample& to) {
    return (to.across_px - from.across_px) / static_cast<float>(to.along_px - from.along_px);
  };
  const auto rows = static_cast<float>(b.along_px - a.along_px);
  const float step = b.across_px - a.across_px;
  const float limit = static_cast<float>(max_step_widths) * std::max(a.width_px, b.width_px) +
                      3.0F * std::hypot(a.sigma_px, b.sigma_px);
  float least = std::abs(step);
  if (i >= 2) {
    const LineSample& before = trace[i - 1 - std::min(i - 1, kReach)];
    least = std::min(least, std::abs(step - rows * slope(before, a)));
  }
  if (i + 1 < trace.size()) {
    const LineSample& after = trace[std::min(i + kReach, trace.size() - 1)];
    least = std::min(least, std::abs(step - rows * slope(b, after)));
  }
  return least > limit;
}

/// Number of samples to remove from the end at `begin`. Works for forward and reverse iterators.
template <typename It>
std::ptrdiff_t mixed_count(It begin, It end, int along_count, const TrimOptions& options) {
  const int border = std::min(begin->along_px, along_count - 1 - begin->along_px);
  const float width = begin->width_px;
  if (static_cast<float>(border) < width) return 0;
  It it = begin;
  const auto beyond = static_cast<int>(std::lround(options.end_widths * width));
  while (it != end && std::abs(it->along_px - begin->along_px) < beyond) ++it;
  const auto inside = static_cast<std::ptrdiff_t>(std::lround(width));
  while (end - it > inside &&
         it->amplitude < options.min_end_amplitude * (it + inside)->amplitude) {
    ++it;
  }
  return it - begin;
}

void add_trimmed(const LineTrace& segment, int along_count, const TrimOptions& options,
                 std::vector<LineTrace>& result) {
  const auto size = static_cast<std::ptrdiff_t>(segment.size());
  const auto front = mixed_count(segment.begin(), segment.end(), along_count, options);
  const auto back = mixed_count(segment.rbegin(), segment.rend(), along_count, options);
  const float length = static_cast<float>(size - front - back);
  const float width = segment[segment.size() / 2].width_px;
  if (length < std::max(static_cast<float>(options.min_length), kMinLengthWidths * width)) return;
  result.emplace_back(segment.begin() + front, segment.end() - back);
}

}  // namespace

Result<void> TrimOptions::validate() const {
  return OptionCheck("TrimOptions")
      .in_range("end_widths", end_widths, 0.0, 5.0)
      .in_range("min_end_amplitude", min_end_amplitude, 0.0, 1.0)
      .positive("max_step_widths", max_step_widths)
      .at_least("min_length", min_length, 3)
      .result();
}

std::vector<LineTrace> trim_traces(const std::vector<LineTrace>& traces, int along_count,
                                   const TrimOptions& options) {
  std::vector<LineTrace> result;
  for (const LineTrace& trace : traces) {
    LineTrace segment;
    for (std::size_t i = 0; i < trace.size(); ++i) {
      if (i > 0 && breaks(trace, i, options.max_step_widths)) {
        add_trimmed(segment, along_count, options, result);
        segment.clear();
      }
      segment.push_back(trace[i]);
    }
    if (!segment.empty()) add_trimmed(segment, along_count, options, result);
  }
  return result;
}

}  // namespace flytri::localization
