#include "hw/recording/replay_sensor.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/base/check_options.h"
#include "core/io/calibrations/recording_calibration.h"

namespace flytri::recording {

Result<void> ReplayOptions::validate() const {
  return OptionCheck("ReplayOptions")
      .not_negative("speed", speed)
      .in_range("ahead", ahead, 1, 256)
      .result();
}

Result<std::shared_ptr<ReplaySensor>> ReplaySensor::open(const std::filesystem::path& folder,
                                                         const ReplayOptions& options,
                                                         device::Clock clock) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  auto recording = io::open_recording(folder);
  if (!recording) return tl::unexpected(recording.error());
  ReplayOptions complete = options;
  if (!complete.calibration && recording->calibration) {
    auto used = io::calibration_of(*recording, {});
    if (!used) return tl::unexpected(used.error());
    complete.calibration =
        std::make_shared<const calibration::Calibration>(std::move(used->calibration));
  }
  return std::shared_ptr<ReplaySensor>(
      new ReplaySensor(*std::move(recording), std::move(complete), std::move(clock)));
}

ReplaySensor::ReplaySensor(io::Recording recording, ReplayOptions options, device::Clock clock)
    : recording_(std::move(recording)), options_(std::move(options)), clock_(std::move(clock)) {}

Result<void> ReplaySensor::start() {
  if (status_.state() == device::SensorState::kRunning) return {};
  {
    const std::lock_guard lock(mutex_);
    to_deliver_ = to_decode_ = 0;
    ready_.clear();
  }
  start_s_ = clock_.now_s();
  status_.restart();
  taken_.notify_all();
  return {};
}

void ReplaySensor::stop() { status_.set(device::SensorState::kIdle); }

Result<std::optional<Frame>> ReplaySensor::next(double timeout_s) {
  const device::SensorState state = status_.state();
  if (state == device::SensorState::kEnded) return std::nullopt;
  if (state != device::SensorState::kRunning)
    return fail(ErrorCode::kBadOption, "{}: start it first", name());
  if (!wait_until_due(timeout_s)) return std::nullopt;
  std::optional<Result<Frame>> frame = take(timeout_s);
  if (!frame) return std::nullopt;
  if (to_deliver_ == recording_.frames.size())
    status_.set(device::SensorState::kEnded, status_.status().message);
  if (!*frame) {
    status_.count_dropped(1);
    status_.set(status_.state(), frame->error().message);
    return std::nullopt;
  }
  status_.count_delivered();
  return **std::move(frame);
}

bool ReplaySensor::wait_until_due(double timeout_s) const {
  if (options_.speed <= 0.0) return true;
  const auto& frames = recording_.frames;
  const double since_first_s = frames[to_deliver_].time_s - frames.front().time_s;
  const double due_s = start_s_ + since_first_s / options_.speed;
  clock_.sleep_s(std::min(due_s - clock_.now_s(), timeout_s));
  // Allows for rounding of the clock.
  return clock_.now_s() >= due_s - 1e-6;
}

std::optional<std::size_t> ReplaySensor::claim(std::size_t limit) {
  const bool open = to_decode_ < std::min(to_deliver_ + limit, recording_.frames.size());
  return open ? std::optional(to_decode_++) : std::nullopt;
}

void ReplaySensor::decode(std::size_t index) {
  std::optional<io::FrameSizes> sizes;
  if (const auto& calibration = options_.calibration)
    sizes = {calibration->measurement_size, calibration->texture_size};
  Result<Frame> frame = io::load_frame(recording_, FrameIndex(index), sizes);
  {
    const std::lock_guard lock(mutex_);
    ready_.emplace(index, std::move(frame));
  }
  decoded_.notify_all();
}

// Decodes the next frame on this thread, unless the background thread has started to.
std::optional<Result<Frame>> ReplaySensor::take(double timeout_s) {
  std::unique_lock lock(mutex_);
  if (const auto mine = claim(1)) {
    lock.unlock();
    decode(*mine);
    lock.lock();
  }
  const auto there = [this] { return ready_.contains(to_deliver_); };
  if (!decoded_.wait_for(lock, std::chrono::duration<double>(timeout_s), there))
    return std::nullopt;
  std::optional<Result<Frame>> frame = std::move(ready_.at(to_deliver_));
  ready_.erase(to_deliver_++);
  lock.unlock();
  taken_.notify_all();
  return frame;
}

bool ReplaySensor::work_in_background(double timeout_s) {
  std::unique_lock lock(mutex_);
  const auto limit = static_cast<std::size_t>(options_.ahead);
  const auto room = [&] {
    return to_decode_ < std::min(to_deliver_ + limit, recording_.frames.size());
  };
  if (status_.state() != device::SensorState::kRunning) return false;
  if (!taken_.wait_for(lock, std::chrono::duration<double>(timeout_s), room)) return false;
  const std::size_t index = *claim(limit);
  lock.unlock();
  decode(index);
  return true;
}

}  // namespace flytri::recording
