#include "hw/sync/light_plan.h"

#include <algorithm>

#include "core/base/check_options.h"

namespace flytri::sync {
namespace {

// Sequence while the latency is learned: dark frames at the start; then rounds of slots with
// patterns, one flash and one dark slot.
constexpr double kDarkAtFirst = 8.0;
constexpr int kRound = 12, kFlashInRound = 5, kDarkInRound = 11;
constexpr double kLearningDark = 1.7;
// Duration of a pattern while the latency is learned, in frames: random, from the first number to
// the sum of both.
constexpr double kLearningShortest = 1.2, kLearningSpread = 1.0;
// Share of slots that repeat the pattern before.
constexpr double kLearningRepeat = 0.15;

device::Light light_of(Pattern pattern) {
  return pattern == Pattern::kVertical ? device::Light::kVertical : device::Light::kHorizontal;
}

}  // namespace

Result<void> LightPlanOptions::validate() const {
  return OptionCheck("LightPlanOptions")
      .positive("flash_period_s", flash_period_s)
      .in_range("flash_frames", flash_frames, 1, 10)
      .positive_up_to("flash_duty", flash_duty, 1.0)
      .in_range("margin", margin, 0.0, 0.5)
      .result();
}

LightPlan::LightPlan(const LightPlanOptions& options) : options_(options), random_(options.seed) {}

std::vector<device::LightRequest> LightPlan::plan(double now_s, double until_s,
                                                  const CameraTiming& timing) {
  if (!is_started_) {
    is_started_ = true;
    next_s_ = flash_s_ = now_s;
  }
  std::vector<device::LightRequest> requests;
  // Do not plan into the past.
  next_s_ = std::max(next_s_, now_s);
  while (next_s_ < until_s) {
    choose_frames_per_pattern(timing);
    const Slot slot = next_slot(timing);
    requests.push_back({slot.light, next_s_});
    const double end_s = next_s_ + slot.duration_s;
    next_s_ = timing.is_learned ? into_gap(end_s, timing) : end_s;
    if (!timing.is_learned)
      in_step_since_s_.reset();
    else if (!in_step_since_s_)
      in_step_since_s_ = next_s_;
  }
  return requests;
}

LightPlan::Slot LightPlan::next_slot(const CameraTiming& timing) {
  const double period_s = timing.clock.period_s();
  if (!timing.is_learned) return learning_slot(period_s);
  if (next_s_ - flash_s_ >= options_.flash_period_s &&
      (!options_.has_flash || may_flash(period_s))) {
    flash_s_ = next_s_;
    if (options_.has_flash) return {device::Light::kFlash, options_.flash_frames * period_s};
    return {device::Light::kDark, frames_per_pattern_ * period_s};
  }
  return {next_pattern(), frames_per_pattern_ * period_s};
}

LightPlan::Slot LightPlan::learning_slot(double period_s) {
  const int slot = learning_slots_++;
  if (slot == 0) return {device::Light::kDark, kDarkAtFirst * period_s};
  if (slot % kRound == kDarkInRound) return {device::Light::kDark, kLearningDark * period_s};
  if (slot % kRound == kFlashInRound && options_.has_flash && may_flash(period_s)) {
    flash_s_ = next_s_;
    return {device::Light::kFlash, options_.flash_frames * period_s};
  }
  const double duration_s = (kLearningShortest + kLearningSpread * random_.uniform()) * period_s;
  // Patterns that only alternate look much the same when shifted by two slots.
  if (random_.uniform() < kLearningRepeat) return {light_of(pattern_), duration_s};
  return {next_pattern(), duration_s};
}

/// Whether the time since the latest flash is long enough for its share.
bool LightPlan::may_flash(double period_s) const {
  return next_s_ - flash_s_ >= options_.flash_frames * period_s / options_.flash_duty;
}

device::Light LightPlan::next_pattern() {
  pattern_ = other(pattern_);
  return light_of(pattern_);
}

void LightPlan::choose_frames_per_pattern(const CameraTiming& timing) {
  if (!timing.is_learned) return;
  const double period_s = timing.clock.period_s();
  const LatencyEstimate& latency = timing.latency;
  // Uses the mean window. If the true one is longer, mixed images appear and it is learned.
  const double window_s = latency.window_s;
  const double distance =
      (0.5 * (period_s - window_s - timing.call_s) - latency.latency_sigma_s) / period_s;
  // Hysteresis, so that a borderline case does not alternate.
  const double needed = frames_per_pattern_ == 1 ? 0.75 * options_.margin : options_.margin;
  frames_per_pattern_ = distance >= needed ? 1 : 2;
}

// The moment nearest to `time_s` in the middle between two exposures; with two frames per pattern,
// in the middle of the frame that is skipped.
double LightPlan::into_gap(double time_s, const CameraTiming& timing) const {
  const double period_s = timing.clock.period_s();
  const double offset_s = frames_per_pattern_ == 1 ? 0.5 * period_s : 0.0;
  // The latency is measured from the middle of the device call.
  const double shift_s = timing.latency.latency_s - offset_s + 0.5 * timing.call_s;
  return timing.clock.next_stamp_s(time_s + shift_s - 0.5 * period_s) - shift_s;
}

}  // namespace flytri::sync
