#include "hw/gpio/gpio_light_switch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "core/base/check_options.h"
#include "hw/device/clock.h"
#include "hw/device/light_budget.h"
#include "hw/device/request_queue.h"
#include "hw/gpio/suspend_watch.h"

namespace flytri::gpio {

namespace {

// Limits the memory if the caller never takes the results.
constexpr std::size_t kMaxDone = 1000;
// Share of a limit at which the thread acts: the chip takes time, and the thread may wake up late.
// The guard acts later (dark_guard.cpp).
constexpr double kSwitchShare = 0.9;
// How long the message of a limit stays.
constexpr double kLimitShown_s = 5.0;
// Longest time that a suspend waits for the chip; logind waits no longer than five seconds.
constexpr std::chrono::seconds kSuspendDelay{3};

std::chrono::steady_clock::time_point time_point(double time_s) {
  using Clock = std::chrono::steady_clock;
  return Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_s)));
}

}  // namespace

Result<void> GpioLightSwitchOptions::validate() const {
  return OptionCheck("GpioLightSwitchOptions")
      .positive("search_period_s", search_period_s)
      .positive("slow_call_s", slow_call_s)
      .nested(limits)
      .result();
}

// State shared by the thread and its callers. The device is only accessed without the lock.
struct GpioLightSwitch::Worker {
  Worker(OpenLightLines opener, const GpioLightSwitchOptions& given)
      : open(std::move(opener)), options(given), budget(given.limits.tightened(kSwitchShare)) {}

  void run();
  void search(std::unique_lock<std::mutex>& lock);
  void serve(std::unique_lock<std::mutex>& lock);
  void carry_out(std::unique_lock<std::mutex>& lock, const device::NumberedRequest& request);
  void suspend(bool suspends);
  [[nodiscard]] bool is_lit() const { return std::isfinite(budget.dark_by_s()); }
  void turn_dark(std::unique_lock<std::mutex>& lock);
  void note_limit(device::Light light);
  void lose(std::unique_lock<std::mutex>& lock, std::string message);
  void note_duration(double call_s);

  const OpenLightLines open;
  const GpioLightSwitchOptions options;
  const device::Clock clock = device::machine_clock();
  std::thread thread;
  std::unique_ptr<SuspendWatch> suspend_watch;  // while the switch runs
  std::unique_ptr<LightLines> lines;            // used by the thread only, while it runs

  std::mutex mutex;  // guards all members below
  std::condition_variable changed;
  bool running = false;
  device::RequestQueue requests;
  std::deque<device::LightSwitching> done;
  device::NumberedRequest latest;  // carried out or tried
  device::LightBudget budget;      // outlives stop(): a restart gives no new credit
  bool is_suspending = false;      // all requests leave the lights dark
  std::condition_variable darkened;
  std::string limit_message;
  double limited_s = 0.0;              // time of limit_message
  std::optional<double> call_began_s;  // start of the device call in progress
  device::LightSwitchStatus status;
};

void GpioLightSwitch::Worker::run() {
  std::unique_lock lock(mutex);
  while (running) {
    if (lines)
      serve(lock);
    else
      search(lock);
  }
  budget.finish(device::Light::kDark, clock.now_s());
  lock.unlock();
  lines.reset();
}

// While the device is lost, due requests are skipped; the latest one is carried out when it is
// back.
void GpioLightSwitch::Worker::search(std::unique_lock<std::mutex>& lock) {
  changed.wait_until(lock, time_point(clock.now_s() + options.search_period_s),
                     [&] { return !running; });
  if (!running) return;
  lock.unlock();
  auto opened = open();
  lock.lock();
  if (const auto passed = requests.take_due(clock.now_s())) {
    latest = passed->request;
    status.skipped += passed->skipped + 1;
  }
  if (!opened) {
    status.message = opened.error().message;
    return;
  }
  lines = std::move(*opened);
  // Stopped meanwhile: do not turn on a light.
  if (!running) return;
  status.state = device::LightSwitchState::kRunning;
  status.message.clear();
  ++status.returned;
  if (latest.number == 0) return;
  // Carry out the latest request, although it was counted as skipped or refused.
  const device::NumberedRequest again = latest;
  carry_out(lock, again);
}

void GpioLightSwitch::Worker::serve(std::unique_lock<std::mutex>& lock) {
  const double check_s = clock.now_s() + options.search_period_s;
  const double end_s = std::min(check_s, budget.dark_by_s());
  const auto wake_s = [&] { return std::min(end_s, requests.first_due_s().value_or(end_s)); };
  const auto must_be_dark = [this] { return is_suspending && is_lit(); };
  while (running && !must_be_dark() && !requests.is_due(clock.now_s()) && clock.now_s() < end_s)
    changed.wait_until(lock, time_point(wake_s()));
  if (!running) return;
  if (must_be_dark()) return turn_dark(lock);
  if (clock.now_s() >= budget.dark_by_s()) {
    note_limit(latest.request.light);
    return turn_dark(lock);
  }
  if (const auto due = requests.take_due(clock.now_s())) {
    status.skipped += due->skipped;
    carry_out(lock, due->request);
  } else if (!lines->present()) {
    lose(lock, "the light switch (GPIO chip) was unplugged: plug it in again");
  }
}

// The light stays off until a later request.
void GpioLightSwitch::Worker::turn_dark(std::unique_lock<std::mutex>& lock) {
  ++status.limited;
  carry_out(lock, {latest.number, {device::Light::kDark, clock.now_s()}});
}

void GpioLightSwitch::Worker::suspend(bool suspends) {
  std::unique_lock lock(mutex);
  is_suspending = suspends;
  changed.notify_all();
  if (suspends) darkened.wait_for(lock, kSuspendDelay, [this] { return !running || !is_lit(); });
}

void GpioLightSwitch::Worker::note_limit(device::Light light) {
  const device::LightLimit& limit = options.limits.of(light);
  limited_s = clock.now_s();
  limit_message = fmt::format(
      "the {} light was turned off because it was on for too long (limits in rig.json: max_on_s "
      "{:g}, max_duty {:g}): wait some seconds",
      device::to_string(light), limit.max_on_s, limit.max_duty);
}

void GpioLightSwitch::Worker::carry_out(std::unique_lock<std::mutex>& lock,
                                        const device::NumberedRequest& request) {
  latest = request;
  const double before_s = clock.now_s();
  const bool has_credit = budget.may_turn_on(request.request.light, before_s);
  if (!has_credit) note_limit(request.request.light);
  const bool may_turn_on = has_credit && !is_suspending;
  const device::Light light = may_turn_on ? request.request.light : device::Light::kDark;
  if (light != request.request.light) ++status.limited;
  call_began_s = before_s;
  budget.begin(light, before_s);
  lock.unlock();
  const int error = lines->set(light);
  const double after_s = clock.now_s();
  lock.lock();
  call_began_s.reset();
  note_duration(after_s - before_s);
  ++(error == 0 ? status.switched : status.refused);
  done.push_back({request.number, light, before_s, after_s, error == 0});
  if (done.size() > kMaxDone) done.pop_front();
  if (error == 0) {
    budget.finish(light, after_s);
    return darkened.notify_all();
  }
  lose(lock,
       fmt::format(
           "the light switch (GPIO chip) refused a command ({}): unplug it and plug it in again",
           std::generic_category().message(error)));
}

void GpioLightSwitch::Worker::note_duration(double call_s) {
  status.slowest_s = std::max(status.slowest_s, call_s);
  status.message.clear();
  if (call_s > options.slow_call_s)
    status.message = fmt::format(
        "the light switch (GPIO chip) took {:.1f} s for a command and may have ignored it: unplug "
        "it and plug it in again",
        call_s);
}

void GpioLightSwitch::Worker::lose(std::unique_lock<std::mutex>& lock, std::string message) {
  status.state = device::LightSwitchState::kLost;
  status.message = std::move(message);
  ++status.lost;
  // An unplugged chip has no power for its lights; one that answers is set dark by its lines' end.
  budget.finish(device::Light::kDark, clock.now_s());
  // Releasing the lines accesses the device, too.
  lock.unlock();
  lines.reset();
  lock.lock();
}

GpioLightSwitch::GpioLightSwitch(std::unique_ptr<Worker> worker) : worker_(std::move(worker)) {}

GpioLightSwitch::~GpioLightSwitch() { stop(); }

Result<std::unique_ptr<GpioLightSwitch>> GpioLightSwitch::create(
    OpenLightLines open, const GpioLightSwitchOptions& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return std::unique_ptr<GpioLightSwitch>(
      new GpioLightSwitch(std::make_unique<Worker>(std::move(open), options)));
}

Result<std::unique_ptr<GpioLightSwitch>> GpioLightSwitch::create(
    const LightWiring& wiring, const GpioLightSwitchOptions& options) {
  if (const auto valid = wiring.validate(); !valid) return tl::unexpected(valid.error());
  GpioLightSwitchOptions limited = options;
  limited.limits = wiring.limits;
  return create([wiring] { return open_gpio_lines(wiring); }, limited);
}

Result<void> GpioLightSwitch::start() {
  if (worker_->thread.joinable()) return {};
  auto lines = worker_->open();
  const std::lock_guard lock(worker_->mutex);
  worker_->status = {};
  if (!lines) {
    worker_->status.state = device::LightSwitchState::kFailed;
    worker_->status.message = lines.error().message;
    return tl::unexpected(lines.error());
  }
  worker_->lines = std::move(*lines);
  worker_->status.state = device::LightSwitchState::kRunning;
  worker_->running = true;
  worker_->requests.clear();
  worker_->done.clear();
  worker_->latest = {};
  worker_->limit_message.clear();
  worker_->is_suspending = false;
  worker_->thread = std::thread([worker = worker_.get()] { worker->run(); });
  worker_->suspend_watch = std::make_unique<SuspendWatch>(
      [worker = worker_.get()](bool suspends) { worker->suspend(suspends); });
  return {};
}

void GpioLightSwitch::stop() {
  {
    const std::lock_guard lock(worker_->mutex);
    worker_->running = false;
  }
  worker_->changed.notify_all();
  if (worker_->thread.joinable()) worker_->thread.join();
  worker_->darkened.notify_all();
  worker_->suspend_watch.reset();
  // After the join: the thread may have changed the status until then.
  const std::lock_guard lock(worker_->mutex);
  worker_->status.state = device::LightSwitchState::kIdle;
  worker_->status.message.clear();
  worker_->limit_message.clear();
}

std::int64_t GpioLightSwitch::post(const device::LightRequest& request) {
  std::int64_t number = 0;
  {
    const std::lock_guard lock(worker_->mutex);
    if (!worker_->running) return 0;
    number = worker_->requests.post(request);
  }
  worker_->changed.notify_all();
  return number;
}

std::vector<device::LightSwitching> GpioLightSwitch::take_done() {
  const std::lock_guard lock(worker_->mutex);
  std::vector<device::LightSwitching> done(worker_->done.begin(), worker_->done.end());
  worker_->done.clear();
  return done;
}

device::LightSwitchStatus GpioLightSwitch::status() const {
  const std::lock_guard lock(worker_->mutex);
  device::LightSwitchStatus status = worker_->status;
  const double now_s = worker_->clock.now_s();
  if (status.message.empty() && now_s < worker_->limited_s + kLimitShown_s)
    status.message = worker_->limit_message;
  if (!worker_->call_began_s) return status;
  const double busy_s = now_s - *worker_->call_began_s;
  status.slowest_s = std::max(status.slowest_s, busy_s);
  if (busy_s > worker_->options.slow_call_s)
    status.message = fmt::format(
        "the light switch (GPIO chip) has not answered for {:.1f} s: unplug it and plug it in "
        "again",
        busy_s);
  return status;
}

}  // namespace flytri::gpio
