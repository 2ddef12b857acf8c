#include "hw/stream/streamed_camera.h"

#include <algorithm>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::stream {

Result<void> StreamedCameraOptions::validate() const {
  return OptionCheck("StreamedCameraOptions")
      .in_range("buffers", buffers, 2, 32)
      .above("frozen_after_periods", frozen_after_periods, 1.0)
      .positive("restart_after_s", restart_after_s)
      .positive("search_period_s", search_period_s)
      .result();
}

StreamedCamera::StreamedCamera(std::shared_ptr<CameraDriver> driver, device::CameraMatch match,
                               const device::CameraSettings& settings,
                               const StreamedCameraOptions& options, device::Clock clock)
    : driver_(std::move(driver)),
      match_(std::move(match)),
      requested_(settings),
      options_(options),
      clock_(std::move(clock)),
      read_back_(settings),
      name_(match_.name) {}

Result<std::unique_ptr<StreamedCamera>> StreamedCamera::create(
    std::shared_ptr<CameraDriver> driver, const device::CameraMatch& match,
    const device::CameraSettings& settings, const StreamedCameraOptions& options,
    const device::Clock& clock) {
  if (const auto valid = settings.validate(); !valid) return tl::unexpected(valid.error());
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return std::unique_ptr<StreamedCamera>(
      new StreamedCamera(std::move(driver), match, settings, options, clock));
}

device::CameraStatus StreamedCamera::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

device::CameraSettings StreamedCamera::read_back() const {
  const std::lock_guard lock(mutex_);
  return read_back_;
}

std::string StreamedCamera::name() const {
  const std::lock_guard lock(mutex_);
  return name_;
}

Result<void> StreamedCamera::open() {
  auto stream = driver_->open(match_, requested_, options_.buffers);
  if (!stream) return tl::unexpected(stream.error());
  stream_ = std::move(*stream);
  stream_->expect_bits(learned_bits_);
  frame_stamper_.begin_stream(1.0 / stream_->read_back().rate_hz);
  last_arrival_s_ = clock_.now_s();
  const std::lock_guard lock(mutex_);
  read_back_ = stream_->read_back();
  name_ = stream_->name();
  return {};
}

Result<void> StreamedCamera::start() {
  const device::CameraState state = status().state;
  if (state != device::CameraState::kIdle && state != device::CameraState::kFailed) return {};
  frame_stamper_ = {};
  away_ = false;
  auto opened = open();
  const std::lock_guard lock(mutex_);
  status_ = {};
  status_.state = opened ? device::CameraState::kRunning : device::CameraState::kFailed;
  if (!opened) status_.message = opened.error().message;
  return opened;
}

void StreamedCamera::stop() {
  stream_.reset();
  const std::lock_guard lock(mutex_);
  status_.state = device::CameraState::kIdle;
  status_.message.clear();
}

Result<std::optional<device::CameraFrame>> StreamedCamera::next(double timeout_s) {
  const device::CameraStatus before = status();
  if (before.state == device::CameraState::kIdle)
    return fail(ErrorCode::kBadOption, "the camera was not started");
  if (before.state == device::CameraState::kFailed)
    return fail(ErrorCode::kBadOption, "the camera did not start: {}", before.message);
  if (!stream_) {
    search(timeout_s);
    return std::nullopt;
  }
  auto taken = stream_->take(timeout_s);
  if (!taken) {
    ended(taken.error());
    return std::nullopt;
  }
  if (!*taken) {
    watch_for_frames(clock_.now_s());
    return std::nullopt;
  }
  learned_bits_ = stream_->read_back().bits.value_or(0);
  return enter(**taken);
}

device::CameraFrame StreamedCamera::enter(const StreamedImage& image) {
  last_arrival_s_ = clock_.now_s();
  const std::lock_guard lock(mutex_);
  status_.state = device::CameraState::kRunning;
  status_.message.clear();
  return frame_stamper_.enter(image, last_arrival_s_, status_);
}

void StreamedCamera::ended(const StreamEnd& end) {
  stream_.reset();
  next_search_s_ = clock_.now_s();
  const std::lock_guard lock(mutex_);
  status_.state = device::CameraState::kLost;
  status_.message = end.error.message;
  if (end.gone && !std::exchange(away_, true)) ++status_.lost;
}

void StreamedCamera::watch_for_frames(double now_s) {
  // Who sends the triggers knows when images are missing.
  if (!requested_.trigger.empty()) return;
  const double silent_s = now_s - last_arrival_s_;
  // Relative to the frame rate: a slow camera normally takes longer.
  const double rate_hz = stream_->read_back().rate_hz;
  if (silent_s * rate_hz <= options_.frozen_after_periods) return;
  if (silent_s > options_.restart_after_s) {
    stream_.reset();
    next_search_s_ = now_s;
  }
  // It stays frozen until a frame arrives, even across restarts.
  const std::lock_guard lock(mutex_);
  if (status_.state == device::CameraState::kFrozen) return;
  status_.state = device::CameraState::kFrozen;
  status_.message = "the camera sends no frames: if this continues, unplug it and plug it in again";
  ++status_.frozen;
}

void StreamedCamera::search(double timeout_s) {
  const double wait_s = next_search_s_ - clock_.now_s();
  clock_.sleep_s(std::min(wait_s, timeout_s));
  if (wait_s > timeout_s) return;
  const auto opened = open();
  next_search_s_ = clock_.now_s() + options_.search_period_s;
  if (opened) {
    reopened();
    return;
  }
  const std::lock_guard lock(mutex_);
  status_.state = device::CameraState::kLost;
  status_.message = opened.error().message;
  // The stream broke because the camera was unplugged.
  if (opened.error().code == ErrorCode::kNotFound && !std::exchange(away_, true)) ++status_.lost;
}

void StreamedCamera::reopened() {
  const std::lock_guard lock(mutex_);
  if (status_.state != device::CameraState::kFrozen) {
    status_.state = device::CameraState::kRunning;
    status_.message.clear();
  }
  ++(std::exchange(away_, false) ? status_.returned : status_.restarted);
}

}  // namespace flytri::stream
