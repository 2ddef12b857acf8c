#include "hw/simulated/simulated_lights.h"

#include <algorithm>
#include <utility>

namespace flytri {

Result<void> SimulatedLightsOptions::validate() const {
  if (!(call_s >= 0.0))
    return fail(ErrorCode::kBadOption, "call_s must be at least 0, not {}", call_s);
  if (!(act_s >= 0.0))
    return fail(ErrorCode::kBadOption, "act_s must be at least 0, not {}", act_s);
  return {};
}

SimulatedLights::SimulatedLights(const SimulatedLightsOptions& options, Clock clock)
    : options_(options), clock_(std::move(clock)), faults_(options.faults) {}

Result<void> SimulatedLights::start() {
  const std::lock_guard lock(mutex_);
  if (status_.state == LightSwitchState::kRunning) return {};
  status_ = {};
  status_.state = LightSwitchState::kRunning;
  wishes_.clear();
  done_.clear();
  shine(Light::kDark, clock_.now_s());
  return {};
}

void SimulatedLights::stop() {
  const std::lock_guard lock(mutex_);
  wishes_.clear();
  shine(Light::kDark, clock_.now_s());
  status_.state = LightSwitchState::kIdle;
}

std::int64_t SimulatedLights::post(const LightWish& wish) {
  const std::lock_guard lock(mutex_);
  if (status_.state != LightSwitchState::kRunning && status_.state != LightSwitchState::kLost)
    return 0;
  return wishes_.post(wish);
}

std::vector<LightSwitching> SimulatedLights::take_done() {
  const std::lock_guard lock(mutex_);
  advance();
  // A call that is still in progress is not done yet.
  const double now_s = clock_.now_s();
  const auto open = std::find_if(done_.begin(), done_.end(), [&](const LightSwitching& switching) {
    return switching.after_s > now_s;
  });
  std::vector<LightSwitching> done(done_.begin(), open);
  done_.erase(done_.begin(), open);
  return done;
}

LightSwitchStatus SimulatedLights::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

LightTimes SimulatedLights::truth(double from_s, double to_s) {
  const std::lock_guard lock(mutex_);
  advance();
  return truth_.times(from_s, to_s);
}

void SimulatedLights::set_faults(const LightFaults& faults) {
  const std::lock_guard lock(mutex_);
  advance();
  faults_ = faults;
}

void SimulatedLights::set_plugged(bool is_plugged) {
  const std::lock_guard lock(mutex_);
  advance();
  if (is_plugged == is_plugged_) return;
  is_plugged_ = is_plugged;
  ++(is_plugged ? status_.returned : status_.lost);
  status_.state = is_plugged ? LightSwitchState::kRunning : LightSwitchState::kLost;
  status_.message = is_plugged ? "" : "The switch of the lights is not there; plug it in again.";
  if (!is_plugged) shine(Light::kDark, clock_.now_s());
}

void SimulatedLights::advance() {
  const double now_s = clock_.now_s();
  while (is_plugged_ && wishes_.first_due_s()) {
    const double begin_s = std::max(free_s_, *wishes_.first_due_s());
    if (begin_s > now_s) return;
    const DueWish due = *wishes_.take_due(begin_s);
    status_.skipped += due.skipped;
    carry_out(due.wish, begin_s);
  }
}

void SimulatedLights::carry_out(const NumberedWish& wish, double begin_s) {
  free_s_ = begin_s + options_.call_s;
  done_.push_back({wish.number, wish.wish.light, begin_s, free_s_, true});
  ++status_.switched;
  status_.slowest_s = std::max(status_.slowest_s, options_.call_s);
  if (!faults_.is_mute) shine(wish.wish.light, begin_s + options_.act_s);
}

void SimulatedLights::shine(Light light, double from_s) {
  Light shown = light;
  if (faults_.is_swapped && light == Light::kVertical) shown = Light::kHorizontal;
  if (faults_.is_swapped && light == Light::kHorizontal) shown = Light::kVertical;
  const bool is_dead = (shown == Light::kVertical && faults_.no_vertical) ||
                       (shown == Light::kHorizontal && faults_.no_horizontal) ||
                       (shown == Light::kFlash && faults_.no_flash);
  truth_.switched({0, is_dead ? Light::kDark : shown, from_s, from_s, true});
}

}  // namespace flytri
