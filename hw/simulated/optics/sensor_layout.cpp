#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::simulated {
namespace {

// Pose at `center_mm` that looks at the origin; its x axis is close to `across`.
Isometry look_at_origin(const Vec3& center_mm, const Vec3& across, double roll_rad) {
  const Vec3 z = (-center_mm).normalized();
  const Vec3 y = z.cross(across).normalized();
  Isometry T_sensor_device = Isometry::Identity();
  T_sensor_device.linear().col(0) = y.cross(z);
  T_sensor_device.linear().col(1) = y;
  T_sensor_device.linear().col(2) = z;
  T_sensor_device.translation() = center_mm;
  T_sensor_device.rotate(Eigen::AngleAxisd(roll_rad, Vec3::UnitZ()));
  return T_sensor_device;
}

CameraModel make_camera(const SensorLayout& layout) {
  CameraModel camera;
  camera.size = {1024, 768};
  // Mounting errors: a little rolled and tilted, the chip a little off the axis.
  camera.T_sensor_camera = look_at_origin({0.0, 0.0, -layout.distance_mm}, Vec3::UnitX(), 0.004);
  camera.T_sensor_camera.rotate(Eigen::AngleAxisd(0.0015, Vec3(0.8, 0.6, 0.0)));
  camera.focal_px = layout.focal_px;
  camera.principal_px = {515.0, 381.0};
  camera.distortion = {-0.12, 0.03, 2e-4, -1e-4};
  camera.lens = {layout.camera_aperture_mm, layout.focus_mm};
  camera.diffraction_sigma_px = 0.6;
  return camera;
}

CameraModel make_texture_camera(const SensorLayout& layout) {
  CameraModel camera;
  camera.size = {1280, 960};
  // Beside the measurement camera, on the side away from the projectors.
  const Vec3 center = layout.distance_mm * Vec3(-0.11, -0.07, -1.05);
  camera.T_sensor_camera = look_at_origin(center, Vec3::UnitX(), -0.006);
  camera.focal_px = layout.texture_focal_px;
  camera.principal_px = {646.0, 473.0};
  camera.distortion = {-0.09, 0.02, -1e-4, 2e-4};
  camera.lens = {0.5 * layout.camera_aperture_mm, 1.08 * layout.distance_mm};
  camera.diffraction_sigma_px = 0.6;
  return camera;
}

ProjectorModel make_projector(const SensorLayout& layout, Pattern pattern) {
  const bool vertical = pattern == Pattern::kVertical;
  const Vec3 across = vertical ? Vec3::UnitX() : Vec3::UnitY();
  const int count = layout.line_counts[static_cast<std::size_t>(pattern)];
  const double extent_mm = layout.volume_mm[vertical ? 0 : 1];

  ProjectorModel projector;
  projector.pattern = pattern;
  projector.T_sensor_projector =
      look_at_origin(layout.baseline_mm * across - layout.distance_mm * Vec3::UnitZ(), across, 0.0);
  projector.distortion = {-0.05, 0.0, 0.0, 0.0};
  projector.lens = {layout.projector_aperture_mm, layout.focus_mm};
  const double distance_mm = projector.center().norm();
  projector.half_width_across = 0.5 * layout.line_width_mm / distance_mm;
  projector.diffraction_sigma = 0.2 * layout.line_width_mm / distance_mm;
  projector.half_length_along = 0.75 * layout.volume_mm.head<2>().maxCoeff() / distance_mm;
  // Lines at equal distances in the middle plane of the volume.
  for (int n = 0; n < count; ++n) {
    const Vec3 target = (n - 0.5 * (count - 1)) * extent_mm / count * across;
    projector.line_across.push_back(projector.slide_place(target)->x());
  }
  return projector;
}

}  // namespace

SensorModel make_sensor(const SensorLayout& layout) {
  SensorModel sensor;
  sensor.volume.size_mm = layout.volume_mm;
  sensor.camera = make_camera(layout);
  sensor.texture_camera = make_texture_camera(layout);
  for (const Pattern pattern : kPatterns)
    sensor.projectors[static_cast<std::size_t>(pattern)] = make_projector(layout, pattern);
  sensor.dots = layout.dots;
  sensor.depth_sigma_mm = layout.depth_sigma_mm;
  return sensor;
}

}  // namespace flytri::simulated
