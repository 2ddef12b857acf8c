#include "hw/simulated/devices/simulated_lights.h"

#include <algorithm>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::simulated {

Result<void> SimulatedLightsOptions::validate() const {
  return OptionCheck("SimulatedLightsOptions")
      .not_negative("call_s", call_s)
      .not_negative("act_s", act_s)
      .nested(limits)
      .result();
}

SimulatedLights::SimulatedLights(const SimulatedLightsOptions& options, device::Clock clock)
    : options_(options),
      clock_(std::move(clock)),
      faults_(options.faults),
      budget_(options.limits) {}

Result<void> SimulatedLights::start() {
  const std::lock_guard lock(mutex_);
  if (status_.state == device::LightSwitchState::kRunning) return {};
  status_ = {};
  status_.state = device::LightSwitchState::kRunning;
  requests_.clear();
  done_.clear();
  shine(device::Light::kDark, clock_.now_s());
  return {};
}

void SimulatedLights::stop() {
  const std::lock_guard lock(mutex_);
  requests_.clear();
  budget_.finish(device::Light::kDark, clock_.now_s());
  shine(device::Light::kDark, clock_.now_s());
  status_.state = device::LightSwitchState::kIdle;
}

std::int64_t SimulatedLights::post(const device::LightRequest& request) {
  const std::lock_guard lock(mutex_);
  if (status_.state != device::LightSwitchState::kRunning &&
      status_.state != device::LightSwitchState::kLost)
    return 0;
  // A request for the past is carried out now.
  return requests_.post({request.light, std::max(request.not_before_s, clock_.now_s())});
}

std::vector<device::LightSwitching> SimulatedLights::take_done() {
  const std::lock_guard lock(mutex_);
  advance();
  // Calls still in progress are not returned yet.
  const double now_s = clock_.now_s();
  const auto open = std::find_if(
      done_.begin(), done_.end(),
      [&](const device::LightSwitching& switching) { return switching.after_s > now_s; });
  std::vector<device::LightSwitching> done(done_.begin(), open);
  done_.erase(done_.begin(), open);
  return done;
}

device::LightSwitchStatus SimulatedLights::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

sync::LightTimes SimulatedLights::truth(double from_s, double to_s) {
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
  status_.state = is_plugged ? device::LightSwitchState::kRunning : device::LightSwitchState::kLost;
  status_.message = is_plugged ? "" : "The simulated light switch is unplugged: plug it in again.";
  if (is_plugged) return;
  budget_.finish(device::Light::kDark, clock_.now_s());
  shine(device::Light::kDark, clock_.now_s());
}

void SimulatedLights::advance() {
  const double now_s = clock_.now_s();
  while (is_plugged_ && requests_.first_due_s()) {
    const double begin_s = std::max(free_s_, *requests_.first_due_s());
    if (begin_s > now_s) break;
    turn_dark_until(begin_s);
    const device::DueRequest due = *requests_.take_due(begin_s);
    status_.skipped += due.skipped;
    carry_out(due.request, begin_s);
  }
  if (is_plugged_) turn_dark_until(now_s);
}

// A light that has reached its limit by then is turned off, as by the real switch.
void SimulatedLights::turn_dark_until(double end_s) {
  const double dark_by_s = budget_.dark_by_s();
  if (dark_by_s > end_s) return;
  ++status_.limited;
  carry_out({latest_, {device::Light::kDark, dark_by_s}}, std::max(free_s_, dark_by_s));
}

void SimulatedLights::carry_out(const device::NumberedRequest& request, double begin_s) {
  const bool may_turn_on = budget_.may_turn_on(request.request.light, begin_s);
  const device::Light light = may_turn_on ? request.request.light : device::Light::kDark;
  if (!may_turn_on) ++status_.limited;
  latest_ = request.number;
  free_s_ = begin_s + options_.call_s;
  budget_.begin(light, begin_s);
  budget_.finish(light, free_s_);
  done_.push_back({request.number, light, begin_s, free_s_, true});
  ++status_.switched;
  status_.slowest_s = std::max(status_.slowest_s, options_.call_s);
  if (!faults_.is_mute) shine(light, begin_s + options_.act_s);
}

void SimulatedLights::shine(device::Light light, double from_s) {
  device::Light shown = light;
  if (faults_.is_swapped && light == device::Light::kVertical) shown = device::Light::kHorizontal;
  if (faults_.is_swapped && light == device::Light::kHorizontal) shown = device::Light::kVertical;
  const bool is_dead = (shown == device::Light::kVertical && faults_.no_vertical) ||
                       (shown == device::Light::kHorizontal && faults_.no_horizontal) ||
                       (shown == device::Light::kFlash && faults_.no_flash);
  truth_.switched({0, is_dead ? device::Light::kDark : shown, from_s, from_s, true});
}

}  // namespace flytri::simulated
