#include "hw/simulated/hand/aimed_pose.h"

#include <algorithm>
#include <vector>

namespace flytri::simulated {
namespace {

// Rays per direction, across the front of the volume, to find the surface.
constexpr int kDepthRays = 7;

}  // namespace

Isometry aimed_pose(const device::HandAim& aim) {
  Isometry T_model_sensor = Isometry::Identity();
  const Vec3 z = -aim.towards_sensor;
  const Vec3 y = z.cross(aim.along).normalized();
  T_model_sensor.linear().col(0) = y.cross(z);
  T_model_sensor.linear().col(1) = y;
  T_model_sensor.linear().col(2) = z;
  T_model_sensor.translation() = aim.target_mm;
  return T_model_sensor;
}

std::optional<double> surface_depth(const RayScene& scene, const SensorModel& sensor,
                                    const Isometry& T_model_sensor) {
  const double reach_mm = 0.9 * sensor.camera.center().norm();
  std::vector<double> depths;
  const Vec3 down = T_model_sensor.linear().col(2);
  for (int j = 0; j < kDepthRays; ++j)
    for (int i = 0; i < kDepthRays; ++i) {
      const Vec2 share(i / (kDepthRays - 1.0) - 0.5, j / (kDepthRays - 1.0) - 0.5);
      const Vec2 place = 0.8 * sensor.volume.size_mm.head<2>().cwiseProduct(share);
      const Ray ray{T_model_sensor * Vec3(place.x(), place.y(), -reach_mm), down};
      if (const auto hit = scene.first_hit(ray))
        depths.push_back((hit->point_mm - ray.origin_mm).dot(down) - reach_mm);
    }
  if (depths.empty()) return std::nullopt;
  std::sort(depths.begin(), depths.end());
  // Ignore surface too far behind the near surface to fit into the volume with it.
  const double nearest = depths[depths.size() / 10];
  const auto too_far =
      std::upper_bound(depths.begin(), depths.end(), nearest + 0.9 * sensor.volume.size_mm.z());
  return 0.5 * (nearest + *(too_far - 1));
}

}  // namespace flytri::simulated
