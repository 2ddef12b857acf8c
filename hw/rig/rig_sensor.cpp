#include "hw/rig/rig_sensor.h"

#include <utility>

#include "core/base/check_options.h"
#include "hw/rig/flash_timing.h"
#include "hw/rig/rig_message.h"

namespace flytri::rig {
namespace {

/// Limit of texture frames read in one step, at least the driver's queue.
constexpr int kMaxQueued = 16;

bool is_away(device::CameraState state) {
  return state == device::CameraState::kLost || state == device::CameraState::kFrozen;
}

}  // namespace

Result<void> RigSensorOptions::validate() const {
  return OptionCheck("RigSensorOptions")
      .positive("flash_period_s", flash_period_s)
      .not_negative("measurement_readout_s", measurement_readout_s)
      .not_negative("texture_readout_s", texture_readout_s)
      .not_negative("patience_s", patience_s)
      .in_range("ahead_s", ahead_s, 0.05, 1.0)
      .nested(limits)
      .result();
}

Result<std::shared_ptr<RigSensor>> RigSensor::create(
    RigDevices devices, const RigSensorOptions& options,
    std::shared_ptr<const calibration::Calibration> calibration) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (devices.measurement == nullptr || devices.lights == nullptr)
    return fail(ErrorCode::kBadOption, "a rig needs a measurement camera and lights");
  return std::shared_ptr<RigSensor>(
      new RigSensor(std::move(devices), options, std::move(calibration)));
}

RigSensor::RigSensor(RigDevices devices, const RigSensorOptions& options,
                     std::shared_ptr<const calibration::Calibration> calibration)
    : devices_(std::move(devices)),
      options_(options),
      calibration_(std::move(calibration)),
      measurement_(devices_.measurement, options.measurement_readout_s) {
  if (devices_.texture) texture_.emplace(devices_.texture, options.texture_readout_s);
}

Result<void> RigSensor::start() {
  const device::SensorState state = status_.state();
  if (state == device::SensorState::kRunning || state == device::SensorState::kLost) return {};
  failure_.reset();
  texture_failure_.clear();
  status_.restart();
  if (auto started = start_devices(); !started) return fail_for_good(started.error());
  const Result<int> flash = plan_flash();
  if (!flash) {
    stop();
    return fail_for_good(flash.error());
  }
  is_away_ = is_resting_ = false;
  const int frames = *flash;
  merger_ = FrameMerger({.start_s = devices_.clock.now_s(),
                         .flash_s = frames / devices_.measurement->read_back().rate_hz,
                         .patience_s = options_.patience_s});
  sync::LightPlanOptions plan;
  plan.has_flash = texture_.has_value();
  plan.flash_period_s = options_.flash_period_s;
  plan.flash_frames = frames;
  plan.flash_duty = kPlannedShare * options_.limits.flash.max_duty;
  plan_ = sync::LightPlan(plan);
  note_status();
  return {};
}

/// The frames of a flash, by what the cameras do and not by what they were asked for.
Result<int> RigSensor::plan_flash() const {
  if (!texture_) return 1;
  const FlashCameras cameras{devices_.measurement->read_back(), devices_.texture->read_back(),
                             options_.texture_readout_s};
  auto allowed = check_flash_period(options_.flash_period_s, cameras, options_.limits.flash);
  if (!allowed) return tl::unexpected(allowed.error());
  return flash_frames(cameras);
}

Result<void> RigSensor::start_devices() {
  // Start the lights first: their guard is a child process that should be forked early.
  if (auto started = devices_.lights->start(); !started) return started;
  auto started = measurement_.start();
  if (started && texture_) {
    started = texture_->start();
    if (!started) measurement_.stop();
  }
  if (!started) devices_.lights->stop();
  return started;
}

Result<void> RigSensor::fail_for_good(const Error& error) {
  failure_ = error;
  status_.set(device::SensorState::kFailed, error.message);
  return tl::unexpected(error);
}

void RigSensor::stop() {
  devices_.lights->stop();
  measurement_.stop();
  if (texture_) texture_->stop();
  status_.set(device::SensorState::kIdle);
}

Result<std::optional<Frame>> RigSensor::next(double timeout_s) {
  if (failure_) return tl::unexpected(*failure_);
  if (status_.state() == device::SensorState::kIdle)
    return fail(ErrorCode::kBadOption, "{}: start it first", options_.name);
  plan_lights();
  // Return a frame that is ready before reading more.
  std::optional<Frame> frame = release();
  if (!frame) {
    if (auto read = read_measurement(timeout_s); !read) {
      stop();
      return tl::unexpected(fail_for_good(read.error()).error());
    }
    read_texture();
    frame = release();
  }
  note_status();
  return frame;
}

void RigSensor::plan_lights() {
  report_switching();
  // The caller's thread may have posted its request for darkness before the last ones of this one.
  const bool rests = rests_;
  if (std::exchange(is_resting_, rests) != rests && rests)
    devices_.lights->post({device::Light::kDark, 0.0});
  if (is_away_ || rests) return;
  const double now_s = devices_.clock.now_s();
  for (const device::LightRequest& request :
       plan_.plan(now_s, now_s + options_.ahead_s, measurement_.labeler().timing())) {
    const std::int64_t number = devices_.lights->post(request);
    if (number == 0) continue;
    measurement_.labeler().posted(number, request.not_before_s);
    if (texture_) texture_->labeler().posted(number, request.not_before_s);
    if (request.light == device::Light::kFlash) merger_.flash_at(request.not_before_s);
  }
}

void RigSensor::rest(bool rests) {
  rests_ = rests;
  if (rests) devices_.lights->post({device::Light::kDark, 0.0});
}

void RigSensor::report_switching() {
  for (const device::LightSwitching& done : devices_.lights->take_done()) {
    measurement_.labeler().switched(done);
    if (texture_) texture_->labeler().switched(done);
  }
}

Result<void> RigSensor::read_measurement(double timeout_s) {
  const auto frame = measurement_.next(timeout_s);
  if (!frame) return tl::unexpected(frame.error());
  const device::LightSwitchStatus lights = devices_.lights->status();
  if (lights.state == device::LightSwitchState::kFailed)
    return fail(ErrorCode::kNotFound, "{}", lights.message);
  const bool was_away = std::exchange(
      is_away_, is_away(measurement_.state()) || lights.state == device::LightSwitchState::kLost);
  if (is_away_ && !was_away) devices_.lights->post({device::Light::kDark, 0.0});
  if (!*frame) return {};
  report_switching();
  if (is_resting_) {
    measurement_.pass(**frame);
    return {};
  }
  const sync::FrameLabel label = measurement_.label(**frame);
  const bool is_pattern =
      label.light == device::Light::kVertical || label.light == device::Light::kHorizontal;
  // If the light switch is unplugged, the lights may be off, and a dark image would not show it.
  if (label.outcome != sync::LabelOutcome::kLabeled || !is_pattern || is_away_) return {};
  const Pattern pattern =
      label.light == device::Light::kVertical ? Pattern::kVertical : Pattern::kHorizontal;
  merger_.add_pattern(pattern, (*frame)->image, label.time_s, devices_.clock.now_s());
  return {};
}

// Reads all texture frames that have arrived, without waiting. Only the measurement camera is
// waited for.
void RigSensor::read_texture() {
  if (!texture_ || !texture_failure_.empty()) return;
  for (int i = 0; i < kMaxQueued; ++i) {
    const auto frame = texture_->next(0.0);
    if (!frame) {
      texture_failure_ = frame.error().message;
      return;
    }
    if (!*frame) return;
    report_switching();
    if (is_resting_) {
      texture_->pass(**frame);
      continue;
    }
    merger_.add_texture((*frame)->image, texture_->label(**frame), devices_.clock.now_s());
  }
}

std::optional<Frame> RigSensor::release() {
  const bool texture_comes = texture_ && texture_failure_.empty() && !is_away(texture_->state());
  std::optional<Frame> frame = merger_.next(devices_.clock.now_s(), texture_comes);
  if (frame) status_.count_delivered();
  return frame;
}

void RigSensor::note_status() {
  RigStatus status;
  status.measurement = measurement_.status();
  if (texture_) status.texture = texture_->status();
  status.lights = devices_.lights->status();
  status.frames_per_pattern = plan_.frames_per_pattern();
  status.keeps_step = plan_.in_step_since_s().has_value();
  status.late = merger_.late();
  status_.set(is_away_ ? device::SensorState::kLost : device::SensorState::kRunning,
              rig_message(status, texture_failure_));
  const std::lock_guard lock(mutex_);
  rig_status_ = std::move(status);
}

device::SensorStatus RigSensor::status() const {
  device::SensorStatus status = status_.status();
  const RigStatus rig = rig_status();
  status.dropped = rig.measurement.camera.dropped + rig.measurement.damaged + rig.late;
  return status;
}

RigStatus RigSensor::rig_status() const {
  const std::lock_guard lock(mutex_);
  return rig_status_;
}

}  // namespace flytri::rig
