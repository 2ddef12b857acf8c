#include "hw/chair/simulated_shots.h"

#include <utility>

namespace flytri {
namespace {

/// Lines are twice as bright at the near end of the volume as in its middle.
constexpr double kShorterExposure = 0.5;
/// A little beyond the volume, so that fits do not end where they are used.
constexpr double kDepthShare = 16.0 / 15.0;

SensorModel with_shorter_exposure(SensorModel sensor) {
  sensor.chip.line_level *= kShorterExposure;
  sensor.chip.ambient_level *= kShorterExposure;
  return sensor;
}

}  // namespace

Result<std::unique_ptr<SimulatedShots>> SimulatedShots::create(
    const SensorModel& sensor, const CalibrationCamera::Options& options) {
  const SensorModel exposed = with_shorter_exposure(sensor);
  auto camera = CalibrationCamera::create(exposed, options);
  if (!camera) return tl::unexpected(camera.error());
  return std::unique_ptr<SimulatedShots>(new SimulatedShots(exposed, options, *std::move(camera)));
}

SimulatedShots::SimulatedShots(const SensorModel& sensor, const CalibrationCamera::Options& options,
                               CalibrationCamera camera)
    : sensor_(sensor), options_(options), camera_(std::move(camera)) {}

Result<void> SimulatedShots::set_mishap(const SimulatedMishap& mishap) {
  auto camera = CalibrationCamera::create(mishap.sensor.value_or(sensor_), options_);
  if (!camera) return tl::unexpected(camera.error());
  camera_ = *std::move(camera);
  mishap_ = mishap;
  return {};
}

cv::Mat SimulatedShots::shoot(ShotKind kind, double z_mm) {
  if (mishap_.lights_stay_on && kind == ShotKind::kDark) kind = ShotKind::kVertical;
  if (mishap_.lights_swapped && kind == ShotKind::kVertical) {
    kind = ShotKind::kHorizontal;
  } else if (mishap_.lights_swapped && kind == ShotKind::kHorizontal) {
    kind = ShotKind::kVertical;
  }
  cv::Mat image = camera_.take(kind, z_mm + mishap_.depth_error_mm, stream_++);
  image(mishap_.covered & cv::Rect(0, 0, image.cols, image.rows)).setTo(cv::Scalar::all(0));
  return image;
}

Result<cv::Mat> SimulatedShots::take(ShotKind kind, double z_mm, const Progress& progress) {
  if (progress.cancelled()) return stopped();
  return shoot(kind, z_mm);
}

Result<cv::Mat> SimulatedShots::look(ShotKind kind, double z_mm, const Progress& progress) {
  return take(kind, z_mm, progress);
}

CalibrationPlan plan_of(const SensorModel& sensor, int plane_count) {
  CalibrationPlan plan;
  plan.volume = sensor.volume;
  for (const Pattern pattern : kPatterns) {
    plan.line_counts[static_cast<std::size_t>(pattern)] = sensor.projector(pattern).line_count();
  }
  plan.dots = sensor.dots;
  plan.z_mm = even_depths_mm(sensor.volume, plane_count, kDepthShare);
  return plan;
}

}  // namespace flytri
