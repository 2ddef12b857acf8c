#include "core/calibration/verify/pattern_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/calibration/record/sensor_size.h"

namespace flytri::calibration {
namespace {

/// Views farther apart do not tell how the hand moved between them.
constexpr double kLongestStep_s = 0.1;
constexpr std::size_t kLeastJumps = 100;
/// In a span that is known to differ from the time beside it.
constexpr std::size_t kLeastJumpsOfSpan = 60;
constexpr double kCertainSigmas = 5.0;
/// Standard uncertainty of a median, by that of a mean, for normally distributed errors.
constexpr double kMedianByMean = 1.2533;

std::vector<double> component(const std::vector<Vec3>& shifts_mm, Eigen::Index axis) {
  std::vector<double> values;
  values.reserve(shifts_mm.size());
  for (const Vec3& shift : shifts_mm) values.push_back(shift[axis]);
  return values;
}

PatternShift summary_of(const std::vector<Vec3>& shifts_mm, double harmful_mm) {
  PatternShift found;
  found.harmful_mm = harmful_mm;
  found.views = shifts_mm.size();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values = component(shifts_mm, axis);
    found.shift_mm[axis] = median_of(values);
    for (double& value : values) value = std::abs(value - found.shift_mm[axis]);
    // Each view counts in three jumps: as if there were a third of them.
    const double sigma_mm = kSigmaOfMedian * median_of(values) * kMedianByMean *
                            std::sqrt(3.0 / static_cast<double>(shifts_mm.size()));
    found.uncertainty_mm = std::max(found.uncertainty_mm, sigma_mm);
  }
  return found;
}

/// Divides the time of a scan where its shift changes.
class SpanFinder {
 public:
  SpanFinder(const std::deque<PatternShiftGauge::Jump>& jumps, double harmful_mm)
      : harmful_mm_(harmful_mm) {
    for (const auto& jump : jumps) shifts_mm_.push_back(jump.shift_mm);
  }

  struct Range {
    std::size_t begin = 0, end = 0;
    PatternShift shift;
  };
  /// By rising time.
  [[nodiscard]] std::vector<Range> ranges() const {
    std::vector<Range> found;
    if (shifts_mm_.size() >= kLeastJumps) divide(0, shifts_mm_.size(), found);
    return found;
  }

 private:
  [[nodiscard]] PatternShift summary(std::size_t begin, std::size_t end) const {
    const auto at = [&](std::size_t i) {
      return shifts_mm_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    return summary_of({at(begin), at(end)}, harmful_mm_);
  }

  /// Where the means of both sides differ most.
  [[nodiscard]] std::size_t best_division(std::size_t begin, std::size_t end) const {
    Vec3 all = Vec3::Zero();
    for (std::size_t i = begin; i < end; ++i) all += shifts_mm_[i];
    Vec3 left = Vec3::Zero();
    std::size_t best = begin + kLeastJumpsOfSpan;
    double most = -1.0;
    for (std::size_t i = begin; i + kLeastJumpsOfSpan <= end; ++i) {
      const auto on_left = static_cast<double>(i - begin), on_right = static_cast<double>(end - i);
      if (i >= begin + kLeastJumpsOfSpan) {
        const double between = left.squaredNorm() / on_left + (all - left).squaredNorm() / on_right;
        if (between > most) {
          most = between;
          best = i;
        }
      }
      left += shifts_mm_[i];
    }
    return best;
  }

  void divide(std::size_t begin, std::size_t end, std::vector<Range>& found) const {
    if (end - begin >= 2 * kLeastJumpsOfSpan) {
      const std::size_t middle = best_division(begin, end);
      const PatternShift before = summary(begin, middle), after = summary(middle, end);
      const PatternShift change{after.shift_mm - before.shift_mm,
                                std::hypot(before.uncertainty_mm, after.uncertainty_mm),
                                end - begin, harmful_mm_};
      if (change.is_large()) {
        divide(begin, middle, found);
        divide(middle, end, found);
        return;
      }
    }
    found.push_back({begin, end, summary(begin, end)});
  }

  const double harmful_mm_;
  std::vector<Vec3> shifts_mm_;
};

}  // namespace

double harmful_shift_mm(const Vec3& volume_mm) {
  // Good calibrations stay below a fifth of it.
  constexpr double kOfTeeth_mm = 0.05;
  return kOfTeeth_mm * line_distance_factor(volume_mm);
}

bool PatternShift::is_large() const {
  const double length_mm = shift_mm.norm();
  return length_mm > harmful_mm && length_mm > kCertainSigmas * uncertainty_mm;
}

void PatternShiftGauge::add(const AlignedView& view) {
  latest_.push_back({view.view->pattern, view.view->time_s, view.T_world_sensor});
  if (latest_.size() > 3) latest_.pop_front();
  while (!jumps_.empty() && jumps_.front().time_s < view.view->time_s - remembered_s_)
    jumps_.pop_front();
  if (latest_.size() < 3) return;
  const Placed &before = latest_[0], &middle = latest_[1], &after = latest_[2];
  const double first_s = middle.time_s - before.time_s, second_s = after.time_s - middle.time_s;
  const bool alternates = before.pattern != middle.pattern && after.pattern != middle.pattern;
  const bool is_near =
      first_s > 0.0 && second_s > 0.0 && first_s <= kLongestStep_s && second_s <= kLongestStep_s;
  if (!alternates || !is_near) return;
  const Isometry T_world_expected =
      interpolate(before.T_world_sensor, after.T_world_sensor, first_s / (first_s + second_s));
  // What is measured too far away lies in its place only if the sensor seems nearer.
  const Vec3 jump_mm = -(T_world_expected.inverse() * middle.T_world_sensor).translation();
  jumps_.push_back(
      {middle.time_s, middle.pattern == Pattern::kVertical ? jump_mm : Vec3(-jump_mm)});
}

std::optional<PatternShift> PatternShiftGauge::shift() const {
  if (jumps_.size() < kLeastJumps) return std::nullopt;
  std::vector<Vec3> shifts_mm;
  shifts_mm.reserve(jumps_.size());
  for (const Jump& jump : jumps_) shifts_mm.push_back(jump.shift_mm);
  return summary_of(shifts_mm, harmful_mm_);
}

std::optional<PatternShift> find_pattern_shift(std::span<const AlignedView> views,
                                               const Vec3& volume_mm) {
  // The gauge forgets; a whole scan is told by its worst time.
  PatternShiftGauge gauge(volume_mm);
  std::optional<PatternShift> worst;
  constexpr std::size_t kStep = 30;
  for (std::size_t i = 0; i < views.size(); ++i) {
    gauge.add(views[i]);
    if (i % kStep != kStep - 1 && i + 1 != views.size()) continue;
    const std::optional<PatternShift> now = gauge.shift();
    if (!now) continue;
    const auto rank = [](const PatternShift& shift) {
      return std::pair(shift.is_large(), shift.shift_mm.norm());
    };
    if (!worst || rank(*now) > rank(*worst)) worst = now;
  }
  return worst;
}

std::vector<ShiftedSpan> find_shifted_spans(std::span<const AlignedView> views,
                                            const Vec3& volume_mm) {
  constexpr double kForever_s = std::numeric_limits<double>::infinity();
  PatternShiftGauge gauge(volume_mm, kForever_s);
  for (const AlignedView& view : views) gauge.add(view);
  const auto time_s = [&](std::size_t jump) { return gauge.jumps()[jump].time_s; };
  std::vector<ShiftedSpan> spans;
  for (const auto& range : SpanFinder(gauge.jumps(), harmful_shift_mm(volume_mm)).ranges()) {
    if (!range.shift.is_large()) continue;
    const bool is_first = range.begin == 0, is_last = range.end == gauge.jumps().size();
    spans.push_back({is_first ? -kForever_s : time_s(range.begin),
                     is_last ? kForever_s : time_s(range.end), range.shift});
  }
  return spans;
}

}  // namespace flytri::calibration
