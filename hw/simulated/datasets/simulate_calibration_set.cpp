#include "hw/simulated/datasets/simulate_calibration_set.h"

#include <cmath>
#include <numbers>

#include "core/base/check_options.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "hw/simulated/datasets/calibration_camera.h"

namespace flytri::simulated {
namespace {

/// @param z_mm  how far the stage has moved, which counts as the depth
/// @param depth_share  how much of that the depth has changed
calibration::CalibrationPlane take_plane(const CalibrationCamera& camera, std::size_t index,
                                         double z_mm, double depth_share, bool has_texture) {
  const double depth_mm = depth_share * z_mm;
  const std::uint64_t stream = 4 * index;
  calibration::CalibrationPlane plane;
  plane.z_mm = z_mm;
  plane.vertical = camera.take(calibration::ShotKind::kVertical, depth_mm, stream);
  plane.horizontal = camera.take(calibration::ShotKind::kHorizontal, depth_mm, stream + 1);
  plane.dots = camera.take(calibration::ShotKind::kDots, depth_mm, stream + 2);
  if (has_texture)
    plane.dots_texture = camera.take(calibration::ShotKind::kDotsTexture, depth_mm, stream + 3);
  return plane;
}

}  // namespace

Result<void> CalibrationSetOptions::validate() const {
  return OptionCheck("CalibrationSetOptions")
      .nested(sensor)
      .in_range("plane_count", plane_count, 5, 100)
      .in_range("depth_share", depth_share, 1.0, 1.5)
      .in_range("stage_tilt_deg.x", stage_tilt_deg.x(), -10.0, 10.0)
      .in_range("stage_tilt_deg.y", stage_tilt_deg.y(), -10.0, 10.0)
      .nested(ImageOptions{.bits = bits, .exposures = exposures})
      .result();
}

Result<calibration::CalibrationSet> take_calibration_set(const CalibrationSetOptions& options,
                                                         const Workers& workers,
                                                         const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const SensorModel& sensor = options.sensor;
  const Vec2 shear = (options.stage_tilt_deg * std::numbers::pi / 180.0).array().tan();
  const auto camera = CalibrationCamera::create(
      sensor, {options.exposures, options.bits, options.noise, options.seed, shear});
  if (!camera) return tl::unexpected(camera.error());

  calibration::CalibrationSet set;
  set.volume = sensor.volume;
  set.line_counts = sensor.line_counts();
  set.dots = sensor.dots;
  set.planes.resize(static_cast<std::size_t>(options.plane_count));
  const std::vector<double> z_mm =
      calibration::even_depths_mm(sensor.volume, options.plane_count, options.depth_share);
  progress.begin_stage("Taking calibration images", set.planes.size());
  workers.for_each(set.planes.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    set.planes[i] =
        take_plane(*camera, i, z_mm[i], 1.0 / std::hypot(1.0, shear.norm()), options.has_texture);
    progress.advance();
  });
  if (progress.cancelled())
    return fail(ErrorCode::kCancelled, "stopped before all calibration images were taken");
  return set;
}

Result<void> simulate_calibration_set(const CalibrationSetOptions& options,
                                      const std::filesystem::path& folder, const Workers& workers,
                                      const Progress& progress) {
  const Result<calibration::CalibrationSet> set = take_calibration_set(options, workers, progress);
  if (!set) return tl::unexpected(set.error());
  return io::write_calibration_set(folder, *set);
}

}  // namespace flytri::simulated
