#include "hw/simulated/simulate_calibration_set.h"

#include <opencv2/imgproc.hpp>

#include "core/interchange/calibration_set_file.h"
#include "hw/simulated/chip.h"
#include "hw/simulated/dot_image.h"
#include "hw/simulated/image_simulator.h"

namespace flytri {
namespace {

// A white square at z = 0 that fills both cameras, facing the sensor.
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

// Everything that the planes have in common.
class PlaneCamera {
 public:
  PlaneCamera(const CalibrationSetOptions& options, ImageSimulator simulator)
      : options_(options),
        simulator_(std::move(simulator)),
        chip_(options.sensor.chip),
        dots_(options.sensor.camera, options.sensor.dots),
        texture_dots_(options.sensor.texture_camera, options.sensor.dots) {}

  CalibrationPlane take(std::size_t index, double z_mm) const {
    Isometry T_model_sensor = Isometry::Identity();
    T_model_sensor.translation().z() = -z_mm;
    const SensorPath path = *SensorPath::from_poses({{0.0, T_model_sensor}});
    CalibrationPlane plane;
    plane.z_mm = z_mm;
    plane.vertical = simulator_.measurement_image(Pattern::kVertical, path, 0.0, 4 * index);
    plane.horizontal = simulator_.measurement_image(Pattern::kHorizontal, path, 0.0, 4 * index + 1);
    const cv::Mat dots = dots_.light(z_mm);
    plane.dots = chip_.read_out(
        {cv::Mat::zeros(dots.size(), CV_32FC1), dots},
        {options_.bits, options_.exposures, options_.noise, options_.seed, 4 * index + 2});
    cv::Mat color;
    cv::cvtColor(texture_dots_.light(z_mm), color, cv::COLOR_GRAY2RGB);
    plane.dots_texture =
        chip_.read_out_color(color, {8, 1, options_.noise, options_.seed, 4 * index + 3});
    return plane;
  }

 private:
  const CalibrationSetOptions& options_;
  ImageSimulator simulator_;
  Chip chip_;
  DotImage dots_, texture_dots_;
};

}  // namespace

Result<void> CalibrationSetOptions::validate() const {
  if (auto valid = sensor.validate(); !valid) return valid;
  if (plane_count < 5 || plane_count > 100)
    return fail(ErrorCode::kBadOption, "plane_count must be in 5..100, not {}", plane_count);
  if (!(depth_share >= 1.0 && depth_share <= 1.5))
    return fail(ErrorCode::kBadOption, "depth_share must be in 1..1.5, not {}", depth_share);
  return ImageOptions{.bits = bits, .exposures = exposures}.validate();
}

Result<CalibrationSet> take_calibration_set(const CalibrationSetOptions& options,
                                            const Workers& workers, const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const SensorModel& sensor = options.sensor;
  // A plane has no silhouettes, on which alone the grid differs from tracing every pixel.
  auto simulator = ImageSimulator::create(white_plane(sensor), sensor,
                                          {.bits = options.bits,
                                           .noise = options.noise,
                                           .motion = false,
                                           .exposures = options.exposures,
                                           .tracing = Tracing::kGrid,
                                           .seed = options.seed});
  if (!simulator) return tl::unexpected(simulator.error());
  const PlaneCamera camera(options, std::move(*simulator));

  CalibrationSet set;
  set.volume = sensor.volume;
  for (const Pattern pattern : kPatterns)
    set.line_counts[static_cast<std::size_t>(pattern)] = sensor.projector(pattern).line_count();
  set.dots = sensor.dots;
  set.planes.resize(static_cast<std::size_t>(options.plane_count));
  progress.begin_stage("Taking calibration images", set.planes.size());
  workers.for_each(set.planes.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    const double share = static_cast<double>(i) / (options.plane_count - 1) - 0.5;
    set.planes[i] = camera.take(i, share * options.depth_share * sensor.volume.size_mm.z());
    progress.advance();
  });
  if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped before the set was whole");
  return set;
}

Result<void> simulate_calibration_set(const CalibrationSetOptions& options,
                                      const std::filesystem::path& folder, const Workers& workers,
                                      const Progress& progress) {
  const Result<CalibrationSet> set = take_calibration_set(options, workers, progress);
  if (!set) return tl::unexpected(set.error());
  return write_calibration_set(folder, *set);
}

}  // namespace flytri
