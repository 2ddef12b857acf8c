#include "hw/simulated/devices/simulated_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::simulated {
namespace {

/// Allowance for rounding of the clock.
constexpr double kDueRounding_s = 1e-9;
constexpr double kRounding = 1e-6;
/// Height of a band of rows with the same exposure time (approximates a rolling shutter).
constexpr int kBand_px = 4;
constexpr const char* kCameraLost = "The simulated camera is unplugged: plug it in again.";

void add_noise(cv::Mat& image, double sigma, std::uint64_t seed) {
  if (sigma <= 0.0) return;
  const double full_scale = image.depth() == CV_16U ? 65535.0 : 255.0;
  cv::Mat noise(image.size(), CV_MAKETYPE(CV_32F, image.channels()));
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::NORMAL, 0.0, sigma * full_scale);
  cv::add(image, noise, image, cv::noArray(), image.type());
}

}  // namespace

Result<void> SimulatedCameraOptions::validate() const {
  return OptionCheck("SimulatedCameraOptions")
      .nested(settings)
      .positive("exposure_s", exposure_s)
      .in_range("dropped_share", dropped_share, 0.0, 1.0)
      .not_negative("readout_s", readout_s)
      .not_negative("jitter_s", jitter_s)
      .not_negative("noise", noise)
      .result();
}

SimulatedCamera::SimulatedCamera(const SimulatedCameraOptions& options, Scene scene,
                                 std::shared_ptr<SimulatedLights> lights, device::Clock clock)
    : options_(options),
      scene_(std::move(scene)),
      lights_(std::move(lights)),
      clock_(std::move(clock)) {}

Result<void> SimulatedCamera::start() {
  const std::lock_guard lock(mutex_);
  if (status_.state == device::CameraState::kRunning) return {};
  start_s_ = clock_.now_s() + options_.phase_s;
  sequence_ = 0;
  status_ = {};
  status_.state = device::CameraState::kRunning;
  return {};
}

void SimulatedCamera::stop() {
  const std::lock_guard lock(mutex_);
  status_.state = device::CameraState::kIdle;
}

ExposureSpan SimulatedCamera::exposure(std::int64_t sequence) const {
  const double half_s = 0.5 * (options_.exposure_s + options_.readout_s);
  const double middle_s = start_s_ + half_s + static_cast<double>(sequence) * period_s();
  return {middle_s, middle_s - half_s, middle_s + half_s};
}

double SimulatedCamera::stamp_s(std::int64_t sequence) const {
  Random random(options_.seed, static_cast<std::uint64_t>(sequence));
  return exposure(sequence).middle_s + options_.latency_s +
         random.uniform(0.0, 1.0) * options_.jitter_s;
}

Result<std::optional<device::CameraFrame>> SimulatedCamera::next(double timeout_s) {
  const device::CameraState state = status().state;
  if (state == device::CameraState::kIdle)
    return fail(ErrorCode::kBadOption, "{}: start it first", options_.name);
  // Exposures that nobody fetched in time are lost.
  const double due_s = std::max(stamp_s(sequence_), exposure(sequence_).end_s);
  clock_.sleep_s(std::min(due_s - clock_.now_s(), timeout_s));
  if (clock_.now_s() < due_s - kDueRounding_s) return std::nullopt;
  const std::int64_t sequence = sequence_++;
  Random random(options_.seed + 1, static_cast<std::uint64_t>(sequence));
  const bool is_dropped = random.uniform() < options_.dropped_share;
  const std::lock_guard lock(mutex_);
  if (!is_plugged_) return std::nullopt;
  if (is_dropped) {
    ++status_.dropped;
    return std::nullopt;
  }
  ++status_.delivered;
  return device::CameraFrame{expose(sequence), stamp_s(sequence),
                             device::StampMeaning::kEndOfReadout, sequence, false};
}

cv::Mat SimulatedCamera::expose(std::int64_t sequence) const {
  const ExposureSpan span = exposure(sequence);
  std::array<cv::Mat, sync::kLightCount> scenes;
  const auto scene = [&](std::size_t light) -> const cv::Mat& {
    if (scenes[light].empty())
      scenes[light] = scene_(static_cast<device::Light>(light), span.middle_s);
    return scenes[light];
  };
  cv::Mat image(scene(sync::at(device::Light::kDark)).size(),
                scene(sync::at(device::Light::kDark)).type());
  const int band_px = options_.readout_s > 0.0 ? kBand_px : image.rows;
  for (int row = 0; row < image.rows; row += band_px) {
    const cv::Range rows(row, std::min(row + band_px, image.rows));
    const double begin_s = span.begin_s + options_.readout_s * row / image.rows;
    const sync::LightTimes times = lights_->truth(begin_s, begin_s + options_.exposure_s);
    cv::Mat light = cv::Mat::zeros(rows.size(), image.cols, CV_MAKETYPE(CV_32F, image.channels()));
    for (std::size_t i = 0; i < sync::kLightCount; ++i) {
      const double share = times.lit_s[i] / options_.exposure_s;
      cv::Mat lit;
      if (share <= kRounding) continue;
      scene(i).rowRange(rows).convertTo(lit, CV_32F);
      cv::scaleAdd(lit, share, light, light);
    }
    light.convertTo(image.rowRange(rows), image.type());
  }
  add_noise(image, options_.noise, options_.seed ^ (static_cast<std::uint64_t>(sequence) << 20U));
  return image;
}

device::CameraStatus SimulatedCamera::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void SimulatedCamera::set_plugged(bool is_plugged) {
  const std::lock_guard lock(mutex_);
  if (is_plugged == is_plugged_) return;
  is_plugged_ = is_plugged;
  ++(is_plugged ? status_.returned : status_.lost);
  status_.state = is_plugged ? device::CameraState::kRunning : device::CameraState::kLost;
  status_.message = is_plugged ? "" : kCameraLost;
}

}  // namespace flytri::simulated
