#include "hw/rig/triggered_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check_options.h"
#include "hw/rig/flash_timing.h"
#include "hw/rig/rig_message.h"

namespace flytri::rig {
namespace {

/// The light shines a little longer than the camera looks.
constexpr double kLightMargin_s = 0.0005;
/// Between exposures the camera is read out, and the command for the next one is on its way.
constexpr double kLeastGap_s = 0.001;
constexpr double kLongestExposure_s = 0.05;
constexpr double kSearchPeriod_s = 0.25;
/// Flashes of a texture camera that is not in step yet.
constexpr double kProbePeriod_s = 0.2;
/// What the board's clock may drift against ours, s per s.
constexpr double kClockDrift = 1e-4;
/// The board counts microseconds in 32 bits.
constexpr double kBoardTurn_s = 4294.967296;

double exposure_of(const device::Camera& camera, double readout_s) {
  const device::CameraSettings settings = camera.read_back();
  return settings.exposure_s.value_or(0.5 / settings.rate_hz) + readout_s + kLightMargin_s;
}

}  // namespace

Result<void> TriggeredSensorOptions::validate() const {
  return OptionCheck("TriggeredSensorOptions")
      .positive("flash_period_s", flash_period_s)
      .not_negative("measurement_readout_s", measurement_readout_s)
      .not_negative("texture_readout_s", texture_readout_s)
      .not_negative("patience_s", patience_s)
      .nested(limits)
      .result();
}

Result<std::shared_ptr<TriggeredSensor>> TriggeredSensor::create(
    TriggeredDevices devices, const TriggeredSensorOptions& options,
    std::shared_ptr<const calibration::Calibration> calibration) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (devices.measurement == nullptr || !devices.open_sequencer)
    return fail(ErrorCode::kBadOption, "a rig needs a measurement camera and lights");
  return std::shared_ptr<TriggeredSensor>(
      new TriggeredSensor(std::move(devices), options, std::move(calibration)));
}

TriggeredSensor::TriggeredSensor(TriggeredDevices devices, const TriggeredSensorOptions& options,
                                 std::shared_ptr<const calibration::Calibration> calibration)
    : devices_(std::move(devices)), options_(options), calibration_(std::move(calibration)) {}

Result<void> TriggeredSensor::start() {
  const device::SensorState state = status_.state();
  if (state == device::SensorState::kRunning || state == device::SensorState::kLost) return {};
  failure_.reset();
  texture_failure_.clear();
  sequencer_message_.clear();
  lights_ = {};
  status_.restart();
  if (auto started = start_devices(); !started) {
    stop();
    return fail_for_good(started.error());
  }
  const double now_s = devices_.clock.now_s();
  next_s_ = now_s;
  flashed_s_ = -std::numeric_limits<double>::infinity();
  clock_offset_s_ = std::numeric_limits<double>::infinity();
  board_s_ = board_turns_s_ = 0.0;
  merger_ = FrameMerger(
      {.start_s = now_s, .flash_s = std::max(flash_s_, 1e-3), .patience_s = options_.patience_s});
  note_status();
  return {};
}

Result<void> TriggeredSensor::start_devices() {
  auto opened = devices_.open_sequencer();
  if (!opened) return tl::unexpected(opened.error());
  sequencer_ = *std::move(opened);
  period_s_ = 1.0 / devices_.measurement->requested().rate_hz;
  measurement_.emplace(devices_.measurement, period_s_);
  if (auto started = measurement_->start(); !started) return started;
  if (devices_.texture != nullptr) {
    texture_.emplace(devices_.texture, period_s_);
    if (auto started = texture_->start(); !started) return started;
  }
  return plan();
}

/// Durations, by what the cameras do and not by what they were asked for.
Result<void> TriggeredSensor::plan() {
  pattern_s_ = exposure_of(*devices_.measurement, options_.measurement_readout_s);
  if (pattern_s_ + kLeastGap_s > period_s_) {
    return fail(
        ErrorCode::kBadOption,
        "exposures of {:.1f} ms do not fit in a period of {:.1f} ms: make \"exposure_s\" or "
        "\"rate_hz\" of the measurement camera smaller in rig.json",
        1e3 * pattern_s_, 1e3 * period_s_);
  }
  if (!texture_) return {};
  flash_s_ = exposure_of(*devices_.texture, options_.texture_readout_s);
  if (flash_s_ > kLongestExposure_s) {
    return fail(ErrorCode::kBadOption,
                "a flash of {:.1f} ms is longer than {:.0f} ms: make \"exposure_s\" of the texture "
                "camera smaller in rig.json",
                1e3 * flash_s_, 1e3 * kLongestExposure_s);
  }
  const double duty = kPlannedShare * options_.limits.flash.max_duty;
  if (flash_s_ <= duty * options_.flash_period_s) return {};
  return fail(ErrorCode::kBadOption,
              "flashes of {:.1f} ms every {:.2f} s exceed the limit max_duty of the flash: make "
              "flash_period_s at least {:.2f} in rig.json",
              1e3 * flash_s_, options_.flash_period_s, flash_s_ / duty);
}

Result<void> TriggeredSensor::fail_for_good(const Error& error) {
  failure_ = error;
  status_.set(device::SensorState::kFailed, error.message);
  return tl::unexpected(error);
}

void TriggeredSensor::stop() {
  sequencer_.reset();
  if (measurement_) measurement_->stop();
  if (texture_) texture_->stop();
  status_.set(device::SensorState::kIdle);
}

Result<std::optional<Frame>> TriggeredSensor::next(double timeout_s) {
  if (failure_) return tl::unexpected(*failure_);
  if (status_.state() == device::SensorState::kIdle)
    return fail(ErrorCode::kBadOption, "{}: start it first", options_.name);
  const double until_s = devices_.clock.now_s() + timeout_s;
  std::optional<Frame> frame;
  do {
    find_sequencer();
    if (sequencer_ && !rests_ && devices_.clock.now_s() >= next_s_) expose_next();
    const bool texture_comes = texture_ && texture_failure_.empty() && texture_->is_in_step();
    frame = merger_.next(devices_.clock.now_s(), texture_comes);
    if (frame) break;
    const double now_s = devices_.clock.now_s();
    const double wake_s = rests_ || !sequencer_ ? until_s : std::min(until_s, next_s_);
    if (auto got = read(std::max(wake_s - now_s, 0.0)); !got) {
      stop();
      return tl::unexpected(fail_for_good(got.error()).error());
    }
  } while (devices_.clock.now_s() < until_s);
  if (frame) status_.count_delivered();
  note_status();
  return frame;
}

void TriggeredSensor::find_sequencer() {
  if (sequencer_ && sequencer_->is_well()) return;
  const double now_s = devices_.clock.now_s();
  if (sequencer_) {
    sequencer_.reset();
    ++lights_.lost;
    search_s_ = now_s;
    sequencer_message_ = "the sequencer was unplugged or went dark by itself";
  }
  if (now_s < search_s_) return;
  search_s_ = now_s + kSearchPeriod_s;
  auto opened = devices_.open_sequencer();
  if (!opened) {
    sequencer_message_ = opened.error().message;
    return;
  }
  sequencer_ = *std::move(opened);
  ++lights_.returned;
  sequencer_message_.clear();
  clock_offset_s_ = std::numeric_limits<double>::infinity();
  measurement_->begin_anew();
  if (texture_) texture_->begin_anew();
}

bool TriggeredSensor::is_flash_due(double now_s) const {
  if (!texture_ || !texture_failure_.empty()) return false;
  const bool is_probe = !texture_->is_in_step() && !texture_->is_silent();
  const double duty = kPlannedShare * options_.limits.flash.max_duty;
  const double probe_s = std::max(kProbePeriod_s, flash_s_ / duty);
  return now_s - flashed_s_ >=
         (is_probe ? std::min(probe_s, options_.flash_period_s) : options_.flash_period_s);
}

void TriggeredSensor::expose_next() {
  const double now_s = devices_.clock.now_s();
  // A caller that was late does not hurry afterwards.
  next_s_ = std::max(next_s_ + period_s_, now_s);
  if (is_flash_due(now_s) && texture_->takes_trigger(now_s)) {
    flashed_s_ = now_s;
    next_s_ = now_s + period_s_ * std::ceil((flash_s_ + kLeastGap_s) / period_s_);
    return expose(device::Light::kFlash, *texture_);
  }
  if (!measurement_->takes_trigger(now_s)) return;
  pattern_ =
      pattern_ == device::Light::kVertical ? device::Light::kHorizontal : device::Light::kVertical;
  expose(pattern_, *measurement_);
}

void TriggeredSensor::expose(device::Light light, TriggeredCamera& camera) {
  const bool is_flash = light == device::Light::kFlash;
  const int output = is_flash                            ? options_.flash
                     : light == device::Light::kVertical ? options_.vertical
                                                         : options_.horizontal;
  const double duration_s = is_flash ? flash_s_ : pattern_s_;
  const double before_s = devices_.clock.now_s();
  const auto exposure = sequencer_->expose(output, is_flash ? 1 : 0, duration_s);
  const double after_s = devices_.clock.now_s();
  lights_.slowest_s = std::max(lights_.slowest_s, after_s - before_s);
  if (!exposure) {
    ++lights_.refused;
    sequencer_message_ = exposure.error().message;
    return;
  }
  ++lights_.switched;
  sequencer_message_.clear();
  // The answer is never early, so the least delay is the best.
  if (exposure->board_s < board_s_) board_turns_s_ += kBoardTurn_s;
  const double board_s = exposure->board_s + board_turns_s_;
  const double passed_s = exposure->board_s - std::exchange(board_s_, exposure->board_s);
  clock_offset_s_ =
      std::min(clock_offset_s_ + kClockDrift * std::max(passed_s, 0.0), after_s - board_s);
  const double begin_s = std::clamp(board_s + clock_offset_s_, before_s, after_s);
  if (is_flash) merger_.flash_at(begin_s);
  camera.triggered(light, begin_s + 0.5 * (duration_s - kLightMargin_s));
}

/// Only the measurement camera is waited for.
Result<void> TriggeredSensor::read(double timeout_s) {
  const auto seen = measurement_->next(timeout_s);
  if (!seen) return tl::unexpected(seen.error());
  const double now_s = devices_.clock.now_s();
  if (*seen) {
    const Pattern pattern =
        (*seen)->light == device::Light::kVertical ? Pattern::kVertical : Pattern::kHorizontal;
    merger_.add_pattern(pattern, (*seen)->image, (*seen)->time_s, now_s);
  }
  if (!texture_ || !texture_failure_.empty()) return {};
  const auto texture = texture_->next(0.0);
  if (!texture) {
    texture_failure_ = texture.error().message;
    return {};
  }
  if (*texture) merger_.add_flash((*texture)->image, (*texture)->time_s, now_s);
  return {};
}

void TriggeredSensor::note_status() {
  RigStatus status;
  status.measurement = measurement_->status();
  if (texture_) status.texture = texture_->status();
  status.lights = lights_;
  const bool is_lost = !sequencer_;
  status.lights.state =
      is_lost ? device::LightSwitchState::kLost : device::LightSwitchState::kRunning;
  status.lights.message = sequencer_message_;
  status.keeps_step = measurement_->is_in_step();
  status.late = merger_.late();
  const device::CameraState camera = status.measurement.camera.state;
  const bool is_away = is_lost || measurement_->is_silent() || camera == device::CameraState::kLost;
  {
    const std::lock_guard lock(mutex_);
    rig_status_ = status;
  }
  std::string told = rig_message(status, texture_failure_);
  const auto silent = [](const TriggeredCamera& triggered, const device::Camera& of, int trigger) {
    return triggered.is_silent()
               ? fmt::format(
                     "{}: no image comes when trigger {} of the sequencer rises; check its "
                     "wire, and \"trigger\" in rig.json",
                     of.name(), trigger)
               : std::string();
  };
  if (told.empty()) told = silent(*measurement_, *devices_.measurement, 0);
  if (told.empty() && texture_) told = silent(*texture_, *devices_.texture, 1);
  status_.set(is_away ? device::SensorState::kLost : device::SensorState::kRunning, told);
}

device::SensorStatus TriggeredSensor::status() const {
  device::SensorStatus status = status_.status();
  const RigStatus rig = rig_status();
  status.dropped = rig.measurement.camera.dropped + rig.measurement.damaged + rig.late;
  return status;
}

RigStatus TriggeredSensor::rig_status() const {
  const std::lock_guard lock(mutex_);
  return rig_status_;
}

}  // namespace flytri::rig
