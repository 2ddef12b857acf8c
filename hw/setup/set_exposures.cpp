#include "hw/setup/set_exposures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "hw/shots/rig_shots.h"

namespace flytri::setup {
namespace {

using calibration::ShotKind;

/// Of full scale. Enamel is as bright as a white sheet at most, and noise needs some room.
constexpr double kWanted = 0.7;
constexpr double kGoodEnough = 0.1;  // of kWanted
constexpr double kSaturated = 0.97;
/// Below this, the lines are too faint for exact places.
constexpr double kTooDark = 0.3;
/// Lines cover little of an image: what is brighter than all but this share.
constexpr double kBrightest = 0.005;
constexpr double kShortest_s = 1e-4;
constexpr double kPatternShare = 0.45, kFlashShare = 0.5;  // of a frame
/// A triggered exposure needs no gap to the next one but for the camera's readout.
constexpr double kTriggeredShare = 0.8;
constexpr int kExposures = 6;

/// The gray value, 0..1, that a share kBrightest of the pixels exceeds; of color images, of the
/// brightest channel.
double brightest_of(const cv::Mat& image) {
  const cv::Mat values = image.reshape(1);
  cv::Mat bytes;
  values.convertTo(bytes, CV_32F, values.depth() == CV_16U ? 1.0 / 65535.0 : 1.0 / 255.0);
  std::vector<float> levels(bytes.begin<float>(), bytes.end<float>());
  const auto place = levels.begin() + static_cast<std::ptrdiff_t>(
                                          static_cast<double>(levels.size()) * (1.0 - kBrightest));
  std::nth_element(levels.begin(), place, levels.end());
  return *place;
}

/// What one camera is exposed for.
struct Exposed {
  std::vector<ShotKind> shots;
  std::string_view name;
  double longest_s = 0.0;
};

class ExposureSearch {
 public:
  ExposureSearch(const rig::RigSettings& rig, const SetupContext& context)
      : rig_(rig), context_(context) {}

  Result<void> set(rig::RigCamera& camera, const Exposed& wanted) {
    double exposure_s = 0.5 * wanted.longest_s;
    double level = 0.0;
    for (int i = 0; i < kExposures; ++i) {
      camera.settings.exposure_s = exposure_s;
      const auto levels = measure(wanted);
      if (!levels) return tl::unexpected(levels.error());
      level = *std::max_element(levels->begin() + 1, levels->end());
      const double next_s = next_exposure_s(exposure_s, level, levels->front(), wanted.longest_s);
      if (std::abs(level - kWanted) < kGoodEnough * kWanted || next_s == exposure_s) break;
      exposure_s = next_s;
    }
    tell(wanted, exposure_s, level);
    return {};
  }

  [[nodiscard]] rig::RigSettings& rig() { return rig_; }

 private:
  /// The brightest places without light, then under each light.
  Result<std::vector<double>> measure(const Exposed& wanted) {
    auto devices = context_.machine.open(rig_);
    if (!devices) return tl::unexpected(devices.error());
    // One switch for all exposures: it knows how long each light was on.
    if (lights_ == nullptr) lights_ = devices->lights;
    devices->lights = lights_;
    shots::RigShotOptions options;
    options.exposures = 2;
    options.limits = rig_.lights.limits;
    auto shots = shots::RigShots::create(*std::move(devices), rig_.name, options);
    if (!shots) return tl::unexpected(shots.error());
    if (auto started = (*shots)->start(); !started) return tl::unexpected(started.error());
    std::vector<double> levels;
    std::vector<ShotKind> kinds = wanted.shots;
    // The texture camera has no dark shot: room light is little beside the flash.
    if (kinds.front() != ShotKind::kDotsTexture)
      kinds.insert(kinds.begin(), ShotKind::kDark);
    else
      levels.push_back(0.0);
    for (const ShotKind kind : kinds) {
      const auto image = (*shots)->take(kind, 0.0, context_.progress);
      if (!image) return tl::unexpected(image.error());
      levels.push_back(brightest_of(*image));
    }
    return levels;
  }

  /// The light of the lines grows with the exposure, what is there without them does not.
  static double next_exposure_s(double exposure_s, double level, double black, double longest_s) {
    if (level > kSaturated) return std::max(kShortest_s, 0.3 * exposure_s);
    const double light = std::max(level - black, 1e-3);
    const double factor = std::clamp((kWanted - black) / light, 0.1, 10.0);
    return std::clamp(factor * exposure_s, kShortest_s, longest_s);
  }

  void tell(const Exposed& wanted, double exposure_s, double level) const {
    context_.talk.tell(fmt::format("Exposure of the {}: {:.2f} ms, brightest places at {:.0f} %",
                                   wanted.name, 1e3 * exposure_s, 100.0 * level));
    if (level > kSaturated)
      context_.talk.tell("They are saturated: lower the current of the LED, and start again.");
    else if (level < kTooDark)
      context_.talk.tell(
          "That is little light: raise the current of the LED within its limits "
          "(docs/light-safety.md), or the gain of the camera in rig.json.");
  }

  rig::RigSettings rig_;
  const SetupContext& context_;
  std::shared_ptr<device::LightSwitch> lights_;
};

}  // namespace

Result<rig::RigSettings> set_exposures(const rig::RigSettings& rig, const SetupContext& context) {
  context.talk.tell("Setting the exposures: leave the white sheet where it is.");
  ExposureSearch search(rig, context);
  rig::RigCamera& measurement = search.rig().measurement;
  const auto set = search.set(measurement, {{ShotKind::kVertical, ShotKind::kHorizontal},
                                            "measurement camera",
                                            (rig.is_triggered() ? kTriggeredShare : kPatternShare) /
                                                measurement.settings.rate_hz});
  if (!set) return tl::unexpected(set.error());
  if (auto& texture = search.rig().texture) {
    const auto flash = search.set(
        *texture,
        {{ShotKind::kDotsTexture}, "texture camera", kFlashShare / texture->settings.rate_hz});
    if (!flash) return tl::unexpected(flash.error());
  }
  return search.rig();
}

}  // namespace flytri::setup
