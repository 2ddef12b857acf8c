#include "hw/shots/rig_shots.h"

#include <algorithm>
#include <utility>

#include "core/base/check_options.h"
#include "hw/rig/open_rig.h"

namespace flytri::shots {
namespace {

constexpr double kLook_s = 0.05;  // interval at which the light switch is polled
// Share of a light's duty that look() takes: the rest is left for the shots.
constexpr double kLookShare = 0.7;

/// The mean image in the format of the calibration set: grey in 16 bits, color in 8.
cv::Mat mean_of(const cv::Mat& sum, int count, int depth) {
  constexpr double kTo16Bits = 257.0;  // 255 becomes 65535
  const bool is_gray = sum.channels() == 1;
  const double scale = is_gray && depth == CV_8U ? kTo16Bits : 1.0;
  cv::Mat mean;
  sum.convertTo(mean, is_gray ? CV_16U : CV_8U, scale / count);
  return mean;
}

}  // namespace

Result<void> RigShotOptions::validate() const {
  return OptionCheck("RigShotOptions")
      .in_range("exposures", exposures, 1, 256)
      .positive("settle_s", settle_s)
      .positive("patience_s", patience_s)
      .nested(limits)
      .result();
}

Result<std::unique_ptr<RigShots>> RigShots::create(rig::RigDevices devices, const std::string& name,
                                                   const RigShotOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return std::unique_ptr<RigShots>(new RigShots(std::move(devices), name, options));
}

RigShots::RigShots(rig::RigDevices devices, const std::string& name, const RigShotOptions& options)
    : devices_(std::move(devices)), name_(name), options_(options) {}

RigShots::~RigShots() { stop(); }

device::Light RigShots::light_of(calibration::ShotKind kind) const {
  switch (kind) {
    case calibration::ShotKind::kDark:
      return device::Light::kDark;
    case calibration::ShotKind::kVertical:
    case calibration::ShotKind::kVerticalAgain:
      return device::Light::kVertical;
    case calibration::ShotKind::kHorizontal:
      return device::Light::kHorizontal;
    case calibration::ShotKind::kDots:
    case calibration::ShotKind::kDotsTexture:
      break;
  }
  return has_texture() ? device::Light::kFlash : device::Light::kDark;
}

Result<void> RigShots::start() {
  shines_ = device::Light::kDark;
  looked_.release();
  if (auto started = devices_.lights->start(); !started) return started;
  for (const auto& camera : {devices_.measurement, devices_.texture}) {
    if (camera == nullptr) continue;
    if (auto started = camera->start(); !started) {
      stop();
      return started;
    }
  }
  steady_s_ = devices_.clock.now_s() + options_.settle_s;
  return {};
}

void RigShots::stop() {
  devices_.lights->stop();
  devices_.measurement->stop();
  if (devices_.texture != nullptr) devices_.texture->stop();
}

// Requests the light again and again while a limit keeps it dark.
Result<void> RigShots::light(device::Light light, const Progress& progress) {
  if (light == shines_) return {};
  std::int64_t request = devices_.lights->post({light, 0.0});
  double given_up_s = devices_.clock.now_s() + options_.patience_s;
  while (!progress.cancelled()) {
    for (const device::LightSwitching& done : devices_.lights->take_done()) {
      if (done.request != request || !done.accepted) continue;
      if (done.light == light) {
        shines_ = light;
        steady_s_ = done.after_s + options_.settle_s;
        return {};
      }
      request = devices_.lights->post({light, devices_.clock.now_s() + kLook_s});
      given_up_s = devices_.clock.now_s() + options_.patience_s;
    }
    if (devices_.clock.now_s() > given_up_s) {
      const std::string message = devices_.lights->status().message;
      return fail(
          ErrorCode::kNotFound, "{}",
          message.empty()
              ? "the light switch (GPIO chip) does not answer: unplug it and plug it in again"
              : message);
    }
    devices_.clock.sleep_s(kLook_s);
  }
  return stopped();
}

void RigShots::darken() {
  if (shines_ == device::Light::kDark) return;
  devices_.lights->post({device::Light::kDark, 0.0});
  shines_ = device::Light::kDark;
  steady_s_ = devices_.clock.now_s() + options_.settle_s;
}

/// Whether a limit turned the light off.
bool RigShots::was_turned_off() {
  for (const device::LightSwitching& done : devices_.lights->take_done())
    if (done.accepted && done.light != shines_) return true;
  return false;
}

Result<cv::Mat> RigShots::average(device::Light light, device::Camera& camera, int exposures,
                                  const Progress& progress) {
  cv::Mat sum;
  int count = 0, depth = CV_8U;
  double given_up_s = devices_.clock.now_s() + options_.patience_s;
  while (count < exposures) {
    if (progress.cancelled()) return stopped();
    auto frame = camera.next(kLook_s);
    if (!frame) return tl::unexpected(frame.error());
    if (was_turned_off()) {
      shines_ = device::Light::kDark;
      const double begin_s = devices_.clock.now_s();
      if (auto lit = this->light(light, progress); !lit) return tl::unexpected(lit.error());
      // The rest of the light is not the camera's fault.
      given_up_s += devices_.clock.now_s() - begin_s;
      continue;
    }
    if (!*frame || (*frame)->damaged || (*frame)->time_s < steady_s_) {
      if (devices_.clock.now_s() < given_up_s) continue;
      const std::string message = camera.status().message;
      return fail(ErrorCode::kNotFound, "{}: {}", camera.name(),
                  message.empty() ? "it sends no images: unplug it and plug it in again" : message);
    }
    const cv::Mat& image = (*frame)->image;
    given_up_s = devices_.clock.now_s() + options_.patience_s;
    depth = image.depth();
    if (sum.empty()) sum = cv::Mat::zeros(image.size(), CV_MAKETYPE(CV_64F, image.channels()));
    cv::add(sum, image, sum, cv::noArray(), CV_64F);
    ++count;
  }
  return mean_of(sum, count, depth);
}

/// The lights are dark at the end, whatever happens.
Result<cv::Mat> RigShots::expose(calibration::ShotKind kind, int exposures,
                                 const Progress& progress) {
  if (kind == calibration::ShotKind::kDotsTexture && !has_texture()) {
    return fail(ErrorCode::kBadOption,
                "{} has no texture camera, but this calibration was begun with one: add it to "
                "rig.json, or begin a calibration in another folder",
                name_);
  }
  const device::Light wanted = light_of(kind);
  const auto lit = light(wanted, progress);
  device::Camera& camera =
      kind == calibration::ShotKind::kDotsTexture ? *devices_.texture : *devices_.measurement;
  auto image = lit ? average(wanted, camera, exposures, progress)
                   : Result<cv::Mat>(tl::unexpected(lit.error()));
  // A switch that did not answer may still carry out the request.
  if (!lit) devices_.lights->post({device::Light::kDark, 0.0});
  darken();
  return image;
}

Result<cv::Mat> RigShots::take(calibration::ShotKind kind, double /*z_mm*/,
                               const Progress& progress) {
  return expose(kind, options_.exposures, progress);
}

Result<cv::Mat> RigShots::look(calibration::ShotKind kind, double /*z_mm*/,
                               const Progress& progress) {
  const double begin_s = devices_.clock.now_s();
  if (kind == looked_kind_ && !looked_.empty() && begin_s < looked_until_s_) return looked_;
  auto image = expose(kind, 1, progress);
  if (!image) return image;
  looked_ = *image;
  looked_kind_ = kind;
  looked_until_s_ = begin_s;
  const device::Light light = light_of(kind);
  if (light == device::Light::kDark) return image;
  const double lit_s = devices_.clock.now_s() - begin_s;
  looked_until_s_ += lit_s / (kLookShare * options_.limits.of(light).max_duty);
  return image;
}

Result<std::unique_ptr<RigShots>> open_rig_shots(const rig::RigSettings& rig, int exposures) {
  auto devices = rig::open_devices(rig);
  if (!devices) return tl::unexpected(devices.error());
  RigShotOptions options;
  options.exposures = exposures;
  options.limits = rig.lights.limits;
  return RigShots::create(*std::move(devices), rig.name, options);
}

}  // namespace flytri::shots
