#include "hw/sync/light_history.h"

#include <algorithm>

namespace flytri::sync {
namespace {

constexpr std::size_t kChanging = kLightCount;

// Number of intervals kept: some seconds, longer than the latency of a frame.
constexpr std::size_t kMaxStretches = 128;

// Weight of the latest call in the running mean.
constexpr double kCallShare = 0.1;

void add(LightTimes& times, std::size_t state, double duration_s) {
  if (duration_s <= 0.0) return;
  (state == kChanging ? times.changing_s : times.lit_s[state]) += duration_s;
}

}  // namespace

void LightHistory::posted(std::int64_t request, double not_before_s) {
  pending_.push_back({request, not_before_s});
}

void LightHistory::switched(const device::LightSwitching& done) {
  while (!pending_.empty() && pending_.front().request <= done.request) pending_.pop_front();
  if (!done.accepted) return;
  const double call_s = std::max(0.0, done.after_s - done.before_s);
  call_s_ = stretches_.empty() ? call_s : call_s_ + kCallShare * (call_s - call_s_);
  stretches_.push_back({done.before_s, kChanging});
  stretches_.push_back({std::max(done.before_s, done.after_s), at(done.light)});
  while (stretches_.size() > kMaxStretches) stretches_.pop_front();
}

LightTimes LightHistory::times(double from_s, double to_s) const {
  // After a due request that is not reported as done, the light is unknown.
  double known_until_s = to_s;
  for (const Pending& request : pending_)
    known_until_s = std::min(known_until_s, std::max(from_s, request.not_before_s));
  LightTimes times;
  double begin_s = from_s;
  std::size_t state = at(device::Light::kDark);
  for (const Stretch& stretch : stretches_) {
    const double end_s = std::clamp(stretch.begin_s, begin_s, known_until_s);
    add(times, state, end_s - begin_s);
    begin_s = end_s;
    state = stretch.state;
  }
  add(times, state, known_until_s - begin_s);
  add(times, kChanging, to_s - std::max(begin_s, known_until_s));
  return times;
}

std::vector<LightTimes> LightHistory::running_times(double start_s, double step_s,
                                                    int count) const {
  std::vector<LightTimes> sums(1);
  sums.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i < count; ++i) {
    const LightTimes step = times(start_s + i * step_s, start_s + (i + 1) * step_s);
    LightTimes sum = sums.back();
    for (std::size_t light = 0; light < kLightCount; ++light) sum.lit_s[light] += step.lit_s[light];
    sum.changing_s += step.changing_s;
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace flytri::sync
