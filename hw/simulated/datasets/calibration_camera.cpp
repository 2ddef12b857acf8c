#include "hw/simulated/datasets/calibration_camera.h"

#include <opencv2/imgproc.hpp>
#include <utility>

namespace flytri::simulated {
namespace {

// A white square at z = 0 facing the sensor, large enough to fill both images.
TriangleMesh white_plane(const SensorModel& sensor) {
  const auto half = static_cast<float>(3.0 * sensor.volume.size_mm.maxCoeff());
  TriangleMesh plane;
  for (const float y : {-half, half})
    for (const float x : {-half, half}) {
      SurfacePoint corner;
      corner.position_mm = {x, y, 0.0F};
      corner.normal = -Vec3f::UnitZ();
      corner.color = {255, 255, 255};
      plane.vertices.push_back(corner);
    }
  plane.triangles = {{0, 2, 1}, {1, 2, 3}};
  return plane;
}

}  // namespace

SensorModel exposed_for_targets(SensorModel sensor) {
  constexpr double kShorterExposure = 0.5;
  sensor.chip.line_level *= kShorterExposure;
  sensor.chip.ambient_level *= kShorterExposure;
  return sensor;
}

Result<CalibrationCamera> CalibrationCamera::create(const SensorModel& sensor,
                                                    const Options& options) {
  // Grid tracing is exact here: it differs from tracing every pixel only at silhouettes.
  auto simulator = ImageSimulator::create(white_plane(sensor), sensor,
                                          {.bits = options.bits,
                                           .noise = options.noise,
                                           .motion = false,
                                           .exposures = options.exposures,
                                           .tracing = Tracing::kGrid,
                                           .seed = options.seed});
  if (!simulator) return tl::unexpected(simulator.error());
  return CalibrationCamera(sensor, options, *std::move(simulator));
}

CalibrationCamera::CalibrationCamera(const SensorModel& sensor, const Options& options,
                                     ImageSimulator simulator)
    : sensor_(sensor),
      options_(options),
      simulator_(std::move(simulator)),
      chip_(sensor.chip),
      dots_(sensor.camera, sensor.dots),
      texture_dots_(sensor.texture_camera, sensor.dots) {}

cv::Mat CalibrationCamera::take(calibration::ShotKind kind, double z_mm,
                                std::uint64_t stream) const {
  const ImageSize& size = sensor_.camera.size;
  switch (kind) {
    case calibration::ShotKind::kDark:
      return evenly_lit(
          cv::Mat(size.height_px, size.width_px, CV_32FC1, cv::Scalar(sensor_.chip.ambient_level)),
          stream);
    case calibration::ShotKind::kVertical:
    case calibration::ShotKind::kVerticalAgain:
      return lines(Pattern::kVertical, z_mm, stream);
    case calibration::ShotKind::kHorizontal:
      return lines(Pattern::kHorizontal, z_mm, stream);
    case calibration::ShotKind::kDots:
      return evenly_lit(dots_.light(dots_at(z_mm)), stream);
    case calibration::ShotKind::kDotsTexture:
      break;
  }
  cv::Mat color;
  cv::cvtColor(texture_dots_.light(dots_at(z_mm)), color, cv::COLOR_GRAY2RGB);
  return chip_.read_out_color(color, {8, 1, options_.noise, options_.seed, stream});
}

Isometry CalibrationCamera::dots_at(double z_mm) const {
  Isometry T_sensor_target = Isometry::Identity();
  T_sensor_target.translation() << z_mm * options_.stage_shear, z_mm;
  return T_sensor_target;
}

cv::Mat CalibrationCamera::lines(Pattern pattern, double z_mm, std::uint64_t stream) const {
  Isometry T_model_sensor = Isometry::Identity();
  T_model_sensor.translation().z() = -z_mm;
  const SensorPath path = *SensorPath::from_poses({{0.0, T_model_sensor}});
  return simulator_.measurement_image(pattern, path, 0.0, stream);
}

cv::Mat CalibrationCamera::evenly_lit(const cv::Mat& light, std::uint64_t stream) const {
  return chip_.read_out({cv::Mat::zeros(light.size(), CV_32FC1), light},
                        {options_.bits, options_.exposures, options_.noise, options_.seed, stream});
}

}  // namespace flytri::simulated
