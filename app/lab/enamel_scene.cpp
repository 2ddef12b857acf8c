#include "app/lab/enamel_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/sphere_mesh.h"

namespace flytri::lab {
namespace {

using simulated::ProjectorModel;
using simulated::SensorModel;

constexpr double kCuspRadius_mm = 3.0;
// Facets of 0.02 mm are 0.02 µm off the sphere.
constexpr int kCuspRings = 450;
// Half the measured part of a plane, across and along the lines. It stays in the volume even if it
// is tilted by 60 degrees.
constexpr double kPlaneHalf_mm = 1.5, kPlaneHalfLength_mm = 6.0;
constexpr double kAroundHighlight_mm = 0.5;

TriangleMesh white(TriangleMesh mesh) {
  for (SurfacePoint& vertex : mesh.vertices) vertex.color = {255, 255, 255};
  return mesh;
}

}  // namespace

int away_from_projector(const SensorModel& sensor) {
  return sensor.projector(kEnamelPattern).center().x() < sensor.camera.center().x() ? 1 : -1;
}

double EnamelScene::below_mm(const Vec3& p_sensor) const {
  if (!is_cusp()) return -(p_sensor - plane.p_sensor).dot(plane.normal);
  const Vec3 center = plane.p_sensor - radius_mm * plane.normal;
  return radius_mm - (p_sensor - center).norm();
}

bool EnamelScene::is_measured(const Vec3& p_sensor) const {
  const Vec3 from = p_sensor - plane.p_sensor;
  if (is_cusp()) return from.norm() <= kAroundHighlight_mm;
  return std::abs(from.x()) <= kPlaneHalf_mm && std::abs(from.y()) <= kPlaneHalfLength_mm;
}

EnamelScene tilted_plane(const SensorModel& sensor, double z_mm, double tilt_degrees) {
  const double tilt_rad = tilt_degrees / 180.0 * std::numbers::pi;
  const Vec3 normal(away_from_projector(sensor) * std::sin(tilt_rad), 0.0, -std::cos(tilt_rad));
  const Vec3 across = Vec3::UnitY().cross(normal);
  // The camera sees all of it, and no line ends on it.
  const double half_mm = sensor.volume.size_mm.maxCoeff();
  EnamelScene scene{z_mm, tilt_degrees, 0.0, {}, {{0.0, 0.0, z_mm}, normal}};
  for (const double y : {-half_mm, half_mm})
    for (const double x : {-half_mm, half_mm}) {
      SurfacePoint corner;
      corner.position_mm = (scene.plane.p_sensor + x * across + y * Vec3::UnitY()).cast<float>();
      corner.normal = normal.cast<float>();
      scene.mesh.vertices.push_back(corner);
    }
  // across x y = normal: counter-clockwise as the sensor sees it.
  scene.mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  scene.mesh = white(std::move(scene.mesh));
  return scene;
}

double middle_line(const ProjectorModel& projector, double z_mm) {
  const double middle = projector.slide_place({0.0, 0.0, z_mm}).value().x();
  return *std::min_element(
      projector.line_across.begin(), projector.line_across.end(),
      [&](double a, double b) { return std::abs(a - middle) < std::abs(b - middle); });
}

EnamelScene glossy_cusp(const SensorModel& sensor, double z_mm, double offset_mm) {
  const ProjectorModel& projector = sensor.projector(kEnamelPattern);
  const Vec3 ray = projector.direction(middle_line(projector, z_mm), 0.0);
  const Vec3 on_line = projector.center() + (z_mm - projector.center().z()) / ray.z() * ray;
  const Vec3 highlight = on_line + offset_mm * Vec3::UnitX();
  const Vec3 normal = ((projector.center() - highlight).normalized() +
                       (sensor.camera.center() - highlight).normalized())
                          .normalized();
  return {z_mm,
          0.0,
          kCuspRadius_mm,
          white(sphere_mesh(highlight - kCuspRadius_mm * normal, kCuspRadius_mm, kCuspRings)),
          {highlight, normal}};
}

}  // namespace flytri::lab
