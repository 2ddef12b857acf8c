#include "hw/simulated/devices/faulty_sensor.h"

#include <algorithm>
#include <utility>

#include "core/base/check_options.h"
#include "core/base/random.h"

namespace flytri::simulated {
namespace {

constexpr const char* kLost =
    "The simulated sensor is unplugged; it will be plugged in again soon.";
constexpr const char* kFailed = "The simulated sensor failed: start it again.";

}  // namespace

Result<void> FaultOptions::validate() const {
  return OptionCheck("FaultOptions")
      .in_range("dropped_share", dropped_share, 0.0, 1.0)
      .in_range("delayed_share", delayed_share, 0.0, 1.0)
      .in_range("unknown_share", unknown_share, 0.0, 1.0)
      .in_range("lost_share", lost_share, 0.0, 1.0)
      .not_negative("max_delay_s", max_delay_s)
      .at_least("max_lost_frames", max_lost_frames, 1)
      .result();
}

Result<std::shared_ptr<FaultySensor>> FaultySensor::create(std::shared_ptr<device::Sensor> sensor,
                                                           const FaultOptions& options,
                                                           device::Clock clock) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return std::shared_ptr<FaultySensor>(
      new FaultySensor(std::move(sensor), options, std::move(clock)));
}

FaultySensor::FaultySensor(std::shared_ptr<device::Sensor> sensor, const FaultOptions& options,
                           device::Clock clock)
    : sensor_(std::move(sensor)), options_(options), clock_(std::move(clock)) {}

Result<void> FaultySensor::start() {
  if (status_.state() == device::SensorState::kRunning) return {};
  count_ = 0;
  lost_frames_ = 0;
  held_.reset();
  status_.restart();
  return sensor_->start();
}

void FaultySensor::stop() {
  status_.set(device::SensorState::kIdle);
  sensor_->stop();
}

Result<std::optional<Frame>> FaultySensor::next(double timeout_s) {
  if (options_.fails_after >= 0 && count_ >= options_.fails_after) {
    status_.set(device::SensorState::kFailed, kFailed);
    sensor_->stop();
    return fail(ErrorCode::kNotFound, "{}", kFailed);
  }
  if (held_) return release(timeout_s);
  auto frame = sensor_->next(timeout_s);
  if (!frame || !*frame) return frame;
  std::optional<Frame> passed = pass(**std::move(frame));
  if (passed) status_.count_delivered();
  return passed;
}

// The delayed frame, when it is due.
std::optional<Frame> FaultySensor::release(double timeout_s) {
  clock_.sleep_s(std::min(release_s_ - clock_.now_s(), timeout_s));
  if (clock_.now_s() < release_s_) return std::nullopt;
  status_.count_delivered();
  return std::exchange(held_, std::nullopt);
}

std::optional<Frame> FaultySensor::pass(Frame frame) {
  Random random(options_.seed, static_cast<std::uint64_t>(count_++));
  const auto happens = [&](double share) { return random.uniform() < share; };
  if (lost_frames_ == 0 && happens(options_.lost_share)) {
    lost_frames_ =
        1 + static_cast<int>(random.below(static_cast<std::uint64_t>(options_.max_lost_frames)));
    status_.set(device::SensorState::kLost, kLost);
  } else if (lost_frames_ > 0 && --lost_frames_ == 0) {
    status_.set(device::SensorState::kRunning);
  }
  if (lost_frames_ > 0 || happens(options_.dropped_share)) {
    status_.count_dropped(1);
    return std::nullopt;
  }
  if (frame.kind != FrameKind::kTexture && happens(options_.unknown_share))
    frame.kind = FrameKind::kUnknown;
  if (!happens(options_.delayed_share)) return frame;
  release_s_ = clock_.now_s() + random.uniform(0.0, options_.max_delay_s);
  held_ = std::move(frame);
  return std::nullopt;
}

device::SensorStatus FaultySensor::status() const {
  const device::SensorStatus within = sensor_->status();
  device::SensorStatus status = status_.status();
  status.dropped += within.dropped;
  // Pass on the wrapped sensor's state, unless this class simulates a fault.
  if (status.state != device::SensorState::kRunning) return status;
  status.state = within.state;
  status.message = within.message;
  return status;
}

}  // namespace flytri::simulated
