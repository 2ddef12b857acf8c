#include "hw/shots/check_linearity.h"

#include <algorithm>
#include <utility>

#include "hw/shots/rig_shots.h"

namespace flytri::shots {
namespace {

constexpr int kSteps = 8;
constexpr int kExposures = 4;

/// The middle of the image, where the sheet is evenly lit, as a share of full scale.
double gray_of(const cv::Mat& image) {
  const cv::Rect middle(image.cols / 4, image.rows / 4, std::max(1, image.cols / 2),
                        std::max(1, image.rows / 2));
  const cv::Scalar mean = cv::mean(image(middle));
  double sum = 0.0;
  for (int channel = 0; channel < image.channels(); ++channel) sum += mean[channel];
  return sum / image.channels() / (image.depth() == CV_16U ? 65535.0 : 255.0);
}

Result<void> check_exposures(const rig::RigSettings& rig) {
  if (rig.texture && rig.texture->settings.exposure_s && rig.measurement.settings.exposure_s)
    return {};
  return fail(ErrorCode::kBadOption,
              "{}: the check of linearity needs a texture camera, and exposure_s of both cameras: "
              "add them to rig.json",
              rig.name);
}

rig::RigSettings exposed(rig::RigSettings rig, double factor) {
  *rig.measurement.settings.exposure_s *= factor;
  *rig.texture->settings.exposure_s *= factor;
  return rig;
}

/// Adds the step of both cameras.
Result<void> take_step(const rig::RigSettings& rig, const rig::RigDevices& devices,
                       std::vector<LinearityReport>& reports, const Progress& progress) {
  RigShotOptions options;
  options.exposures = kExposures;
  options.limits = rig.lights.limits;
  auto shots = RigShots::create(devices, rig.name, options);
  if (!shots) return tl::unexpected(shots.error());
  if (auto started = (*shots)->start(); !started) return started;
  const auto add = [&](LinearityReport& report, const device::Camera& camera,
                       calibration::ShotKind kind) -> Result<void> {
    auto image = (*shots)->take(kind, 0.0, progress);
    if (!image) return tl::unexpected(image.error());
    const device::CameraSettings settings = camera.read_back();
    report.camera = camera.name();
    report.steps.push_back({settings.exposure_s.value_or(0.0), gray_of(*image)});
    return {};
  };
  auto added = add(reports[0], *devices.measurement, calibration::ShotKind::kDots);
  if (added) added = add(reports[1], *devices.texture, calibration::ShotKind::kDotsTexture);
  return added;
}

}  // namespace

Result<std::vector<LinearityReport>> check_linearity(const rig::RigSettings& rig,
                                                     const OpenDevices& open,
                                                     const Progress& progress) {
  if (auto complete = check_exposures(rig); !complete) return tl::unexpected(complete.error());
  std::vector<LinearityReport> reports(2);
  std::shared_ptr<device::LightSwitch> lights;
  for (int i = 1; i <= kSteps; ++i) {
    const rig::RigSettings step = exposed(rig, 2.0 * i / kSteps);
    auto devices = open(step);
    if (!devices) return tl::unexpected(devices.error());
    // One switch for all steps: it knows how long the flash was on.
    if (lights == nullptr) lights = devices->lights;
    devices->lights = lights;
    if (auto taken = take_step(step, *devices, reports, progress); !taken)
      return tl::unexpected(taken.error());
  }
  for (LinearityReport& report : reports) {
    auto judged = rig::judge_linearity(report.steps);
    if (!judged)
      return fail(judged.error().code, "camera {}: {}", report.camera, judged.error().message);
    report.linearity = *judged;
  }
  return reports;
}

std::string advice_on(const LinearityReport& report) {
  if (report.linearity.is_linear) return {};
  return fmt::format(
      "camera {} is not linear: its gray values follow the light with a gamma of {:.2f}, and "
      "differ "
      "from a straight line by up to {:.1f} % of their range: set \"gamma\", \"contrast\" or "
      "\"wide_dynamic_range\" in \"controls\" of rig.json, or use a raw format (GREY, Y16) or "
      "another camera",
      report.camera, report.linearity.gamma, 100.0 * report.linearity.deviation);
}

}  // namespace flytri::shots
