#include "hw/sync/frame_clock.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"

namespace flytri::sync {
namespace {

// A slope over fewer frames is worse than what the camera promises.
constexpr std::size_t kFewestForPeriod = 8;
// So many stamps in a row off the beat are a new beat.
constexpr int kMissesToRestart = 4;
// Periods: after a longer gap the beat is not carried over.
constexpr double kLongestGap = 60.0;

}  // namespace

Result<void> FrameClockOptions::validate() const {
  return OptionCheck("FrameClockOptions")
      .positive("period_s", period_s)
      .in_range("memory", memory, static_cast<double>(kFewestForPeriod), 1000)
      .in_range("max_correction", max_correction, 0.0, 0.5)
      .result();
}

FrameClock::FrameClock(const FrameClockOptions& options)
    : options_(options), period_s_(options.period_s) {}

double FrameClock::beat_s(std::int64_t number) const {
  return origin_s_ + static_cast<double>(number) * period_s_;
}

double FrameClock::add(double stamp_s) {
  const bool gap = !beats_.empty() && stamp_s - beats_.back().stamp_s > kLongestGap * period_s_;
  if (misses_ >= kMissesToRestart || gap) {
    beats_.clear();
    misses_ = 0;
  }
  std::int64_t number = 0;
  if (!beats_.empty()) {
    // The promised period may be wrong: until it is learned, only the latest step is counted by it.
    const Beat& last = beats_.back();
    const double number_of_stamp =
        beats_.size() < kFewestForPeriod
            ? static_cast<double>(last.number) + (stamp_s - last.stamp_s) / period_s_
            : (stamp_s - origin_s_) / period_s_;
    number = std::max<std::int64_t>(last.number + 1, std::llround(number_of_stamp));
  }
  beats_.push_back({number, stamp_s});
  if (beats_.size() > static_cast<std::size_t>(options_.memory)) beats_.pop_front();
  fit();
  const double residual_s = stamp_s - beat_s(number);
  const double limit_s = options_.max_correction * period_s_;
  const bool is_miss = beats_.size() >= kFewestForPeriod && std::abs(residual_s) > limit_s;
  misses_ = is_miss ? misses_ + 1 : 0;
  const double corrected_s = stamp_s - std::clamp(residual_s, -limit_s, limit_s);
  // Rises even where the fit moved back by the step from frame to frame.
  last_s_ = beats_.size() > 1 ? std::max(corrected_s, last_s_ + 1e-6) : corrected_s;
  return last_s_;
}

// Least squares; the slope only where there are enough frames for it.
void FrameClock::fit() {
  const auto count = static_cast<double>(beats_.size());
  double mean_number = 0.0, mean_s = 0.0;
  for (const Beat& beat : beats_) {
    mean_number += static_cast<double>(beat.number - beats_.front().number) / count;
    mean_s += (beat.stamp_s - beats_.front().stamp_s) / count;
  }
  double square = 0.0, product = 0.0;
  for (const Beat& beat : beats_) {
    const double x = static_cast<double>(beat.number - beats_.front().number) - mean_number;
    square += x * x;
    product += x * (beat.stamp_s - beats_.front().stamp_s - mean_s);
  }
  period_s_ = beats_.size() < kFewestForPeriod ? options_.period_s : product / square;
  origin_s_ = beats_.front().stamp_s + mean_s -
              (static_cast<double>(beats_.front().number) + mean_number) * period_s_;
}

double FrameClock::next_stamp_s(double time_s) const {
  if (beats_.empty()) return time_s;
  return beat_s(static_cast<std::int64_t>(std::floor((time_s - origin_s_) / period_s_)) + 1);
}

}  // namespace flytri::sync
