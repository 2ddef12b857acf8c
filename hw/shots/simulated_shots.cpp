#include "hw/shots/simulated_shots.h"

#include <utility>

namespace flytri::shots {
namespace {

/// The planes reach a little beyond the volume, so that the fits are accurate at its ends.
constexpr double kDepthShare = 16.0 / 15.0;

}  // namespace

Result<std::unique_ptr<SimulatedShots>> SimulatedShots::create(
    const simulated::SensorModel& sensor, const simulated::CalibrationCamera::Options& options) {
  const simulated::SensorModel exposed = exposed_for_targets(sensor);
  auto camera = simulated::CalibrationCamera::create(exposed, options);
  if (!camera) return tl::unexpected(camera.error());
  return std::unique_ptr<SimulatedShots>(new SimulatedShots(exposed, options, *std::move(camera)));
}

SimulatedShots::SimulatedShots(const simulated::SensorModel& sensor,
                               const simulated::CalibrationCamera::Options& options,
                               simulated::CalibrationCamera camera)
    : sensor_(sensor), options_(options), camera_(std::move(camera)) {}

Result<void> SimulatedShots::set_faults(const ShotFaults& faults) {
  auto camera = simulated::CalibrationCamera::create(faults.sensor.value_or(sensor_), options_);
  if (!camera) return tl::unexpected(camera.error());
  camera_ = *std::move(camera);
  faults_ = faults;
  return {};
}

cv::Mat SimulatedShots::shoot(calibration::ShotKind kind, double z_mm) {
  if (faults_.lights_stay_on && kind == calibration::ShotKind::kDark)
    kind = calibration::ShotKind::kVertical;
  if (faults_.lights_swapped && kind == calibration::ShotKind::kVertical) {
    kind = calibration::ShotKind::kHorizontal;
  } else if (faults_.lights_swapped && kind == calibration::ShotKind::kHorizontal) {
    kind = calibration::ShotKind::kVertical;
  }
  cv::Mat image = camera_.take(kind, z_mm + faults_.depth_error_mm, stream_++);
  image(faults_.covered & cv::Rect(0, 0, image.cols, image.rows)).setTo(cv::Scalar::all(0));
  return image;
}

Result<cv::Mat> SimulatedShots::shoot_board(calibration::ShotKind kind) {
  if (!board_) {
    auto board = simulated::BoardScene::create(sensor_, {.bits = options_.bits,
                                                         .noise = options_.noise,
                                                         .motion = false,
                                                         .exposures = options_.exposures,
                                                         .seed = options_.seed});
    if (!board) return tl::unexpected(board.error());
    board_ = *std::move(board);
  }
  return board_->take(kind, *T_sensor_board_, stream_++);
}

Result<cv::Mat> SimulatedShots::take(calibration::ShotKind kind, double z_mm,
                                     const Progress& progress) {
  if (progress.cancelled()) return stopped();
  if (T_sensor_board_) return shoot_board(kind);
  return shoot(kind, z_mm);
}

Result<cv::Mat> SimulatedShots::look(calibration::ShotKind kind, double z_mm,
                                     const Progress& progress) {
  return take(kind, z_mm, progress);
}

calibration::CalibrationPlan plan_of(const simulated::SensorModel& sensor, int plane_count) {
  calibration::CalibrationPlan plan;
  plan.volume = sensor.volume;
  plan.line_counts = sensor.line_counts();
  plan.dots = sensor.dots;
  plan.z_mm = calibration::even_depths_mm(sensor.volume, plane_count, kDepthShare);
  return plan;
}

}  // namespace flytri::shots
