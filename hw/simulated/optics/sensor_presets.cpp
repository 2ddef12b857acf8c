/// @file  Models of the two sensors of the paper, built from its numbers.
#include <cmath>
#include <numbers>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {
namespace {

// Paper, section "Physical Optimization": the interior of narrow gaps is visible up to about this
// angle.
constexpr double kTriangulationAngle_rad = 7.0 * std::numbers::pi / 180.0;

// Parameters in which the two sensors differ.
struct Layout {
  Vec3 volume_mm;
  double distance_mm;  // camera and projectors to the middle of the volume
  double focal_px;
  double focus_mm;                 // in front of the volume, see the paper, section "Line Indexing"
  double camera_aperture_mm;       // radius
  double projector_aperture_mm;    // radius; larger than the camera's, to reduce speckle
  double line_width_mm;            // width of a line on the object, in focus
  std::array<int, 2> line_counts;  // by Pattern
  double texture_focal_px;
};

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

CameraModel make_camera(const Layout& layout) {
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

CameraModel make_texture_camera(const Layout& layout) {
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

ProjectorModel make_projector(const Layout& layout, Pattern pattern) {
  const bool vertical = pattern == Pattern::kVertical;
  const Vec3 across = vertical ? Vec3::UnitX() : Vec3::UnitY();
  const int count = layout.line_counts[static_cast<std::size_t>(pattern)];
  const double extent_mm = layout.volume_mm[vertical ? 0 : 1];
  const double baseline_mm = layout.distance_mm * std::tan(kTriangulationAngle_rad);

  ProjectorModel projector;
  projector.pattern = pattern;
  projector.T_sensor_projector =
      look_at_origin(baseline_mm * across - layout.distance_mm * Vec3::UnitZ(), across, 0.0);
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

SensorModel make_sensor(const Layout& layout) {
  SensorModel sensor;
  sensor.volume.size_mm = layout.volume_mm;
  sensor.camera = make_camera(layout);
  sensor.texture_camera = make_texture_camera(layout);
  for (const Pattern pattern : kPatterns)
    sensor.projectors[static_cast<std::size_t>(pattern)] = make_projector(layout, pattern);
  return sensor;
}

}  // namespace

SensorModel intraoral_sensor() {
  SensorModel sensor = make_sensor({.volume_mm = {20.0, 15.0, 15.0},
                                    .distance_mm = 80.0,
                                    .focal_px = 3600.0,
                                    .focus_mm = 70.0,
                                    .camera_aperture_mm = 0.38,
                                    .projector_aperture_mm = 0.58,
                                    .line_width_mm = 0.085,
                                    .line_counts = {10, 7},
                                    .texture_focal_px = 4100.0});
  sensor.dots = {.pitch_mm = 1.0, .diameter_mm = 0.5, .marker_diameter_mm = 0.8};
  sensor.depth_sigma_mm = 0.03;
  return sensor;
}

SensorModel face_sensor() {
  SensorModel sensor = make_sensor({.volume_mm = {200.0, 150.0, 100.0},
                                    .distance_mm = 600.0,
                                    .focal_px = 2720.0,
                                    .focus_mm = 535.0,
                                    .camera_aperture_mm = 2.0,
                                    .projector_aperture_mm = 3.2,
                                    .line_width_mm = 0.85,
                                    .line_counts = {12, 9},
                                    .texture_focal_px = 3100.0});
  sensor.dots = {.pitch_mm = 10.0, .diameter_mm = 5.0, .marker_diameter_mm = 8.0};
  sensor.depth_sigma_mm = 0.12;
  return sensor;
}

}  // namespace flytri::simulated
