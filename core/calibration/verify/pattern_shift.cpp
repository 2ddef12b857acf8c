#include "core/calibration/verify/pattern_shift.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/median.h"

namespace flytri::calibration {
namespace {

/// Views farther apart do not tell how the hand moved between them.
constexpr double kLongestStep_s = 0.1;
/// Long enough to average the hand out, short enough to notice a bump soon.
constexpr double kRemembered_s = 12.0;
constexpr std::size_t kLeastJumps = 100;
/// The model is spoiled by a fraction of this; good calibrations stay below a fifth of it.
constexpr double kLarge_mm = 0.05;
constexpr double kCertainSigmas = 5.0;
/// Standard uncertainty of a median, by that of a mean, for normally distributed errors.
constexpr double kMedianByMean = 1.2533;

std::vector<double> component(const std::vector<Vec3>& shifts_mm, Eigen::Index axis) {
  std::vector<double> values;
  values.reserve(shifts_mm.size());
  for (const Vec3& shift : shifts_mm) values.push_back(shift[axis]);
  return values;
}

std::optional<PatternShift> summary_of(const std::vector<Vec3>& shifts_mm) {
  if (shifts_mm.size() < kLeastJumps) return std::nullopt;
  PatternShift found;
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

}  // namespace

bool PatternShift::is_large() const {
  const double length_mm = shift_mm.norm();
  return length_mm > kLarge_mm && length_mm > kCertainSigmas * uncertainty_mm;
}

void PatternShiftGauge::add(const AlignedView& view) {
  latest_.push_back({view.view->pattern, view.view->time_s, view.T_world_sensor});
  if (latest_.size() > 3) latest_.pop_front();
  while (!jumps_.empty() && jumps_.front().time_s < view.view->time_s - kRemembered_s)
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
  std::vector<Vec3> shifts_mm;
  shifts_mm.reserve(jumps_.size());
  for (const Jump& jump : jumps_) shifts_mm.push_back(jump.shift_mm);
  return summary_of(shifts_mm);
}

std::optional<PatternShift> find_pattern_shift(std::span<const AlignedView> views) {
  // The gauge forgets; a whole scan is told by its worst time.
  PatternShiftGauge gauge;
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

}  // namespace flytri::calibration
