#include "hw/sync/frame_clock.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"

namespace flytri::sync {
namespace {

// With fewer frames, the fitted period is worse than the nominal one.
constexpr std::size_t kFewestForPeriod = 8;
// After this many deviating stamps in a row, the fit starts again.
constexpr int kMissesToRestart = 4;
// In periods. After a longer gap, the fit starts again.
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

double FrameClock::fitted_stamp_s(std::int64_t number) const {
  return origin_s_ + static_cast<double>(number) * period_s_;
}

double FrameClock::add(double stamp_s) {
  const bool gap = !stamps_.empty() && stamp_s - stamps_.back().stamp_s > kLongestGap * period_s_;
  if (misses_ >= kMissesToRestart || gap) {
    stamps_.clear();
    misses_ = 0;
  }
  std::int64_t number = 0;
  if (!stamps_.empty()) {
    // The nominal period may be wrong: until it is learned, use it only for the step from the last
    // frame.
    const NumberedStamp& last = stamps_.back();
    const double number_of_stamp =
        stamps_.size() < kFewestForPeriod
            ? static_cast<double>(last.number) + (stamp_s - last.stamp_s) / period_s_
            : (stamp_s - origin_s_) / period_s_;
    number = std::max<std::int64_t>(last.number + 1, std::llround(number_of_stamp));
  }
  stamps_.push_back({number, stamp_s});
  if (stamps_.size() > static_cast<std::size_t>(options_.memory)) stamps_.pop_front();
  fit();
  const double residual_s = stamp_s - fitted_stamp_s(number);
  const double limit_s = options_.max_correction * period_s_;
  const bool is_miss = stamps_.size() >= kFewestForPeriod && std::abs(residual_s) > limit_s;
  misses_ = is_miss ? misses_ + 1 : 0;
  const double corrected_s = stamp_s - std::clamp(residual_s, -limit_s, limit_s);
  // Keeps the times increasing even if the new fit moved back.
  last_s_ = stamps_.size() > 1 ? std::max(corrected_s, last_s_ + 1e-6) : corrected_s;
  return last_s_;
}

// Least-squares line; uses the nominal period as the slope while there are too few frames.
void FrameClock::fit() {
  const auto count = static_cast<double>(stamps_.size());
  double mean_number = 0.0, mean_s = 0.0;
  for (const NumberedStamp& stamp : stamps_) {
    mean_number += static_cast<double>(stamp.number - stamps_.front().number) / count;
    mean_s += (stamp.stamp_s - stamps_.front().stamp_s) / count;
  }
  double square = 0.0, product = 0.0;
  for (const NumberedStamp& stamp : stamps_) {
    const double x = static_cast<double>(stamp.number - stamps_.front().number) - mean_number;
    square += x * x;
    product += x * (stamp.stamp_s - stamps_.front().stamp_s - mean_s);
  }
  period_s_ = stamps_.size() < kFewestForPeriod ? options_.period_s : product / square;
  origin_s_ = stamps_.front().stamp_s + mean_s -
              (static_cast<double>(stamps_.front().number) + mean_number) * period_s_;
}

double FrameClock::next_stamp_s(double time_s) const {
  if (stamps_.empty()) return time_s;
  return fitted_stamp_s(static_cast<std::int64_t>(std::floor((time_s - origin_s_) / period_s_)) +
                        1);
}

}  // namespace flytri::sync
