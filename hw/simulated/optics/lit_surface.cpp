#include "hw/simulated/optics/lit_surface.h"

#include <algorithm>
#include <cmath>

#include "hw/simulated/optics/view_simulator.h"

namespace flytri::simulated {
namespace {

bool within_a_line(const ProjectorModel& projector, const Vec2& place) {
  if (std::abs(place.y()) > projector.half_length_along) return false;
  const auto& lines = projector.line_across;
  const auto next =
      std::lower_bound(lines.begin(), lines.end(), place.x() - projector.half_width_across);
  return next != lines.end() && *next <= place.x() + projector.half_width_across;
}

class Illumination {
 public:
  Illumination(const RayScene& scene, const SensorModel& sensor)
      : scene_(scene), sensor_(sensor), reach_mm_(0.5 * sensor.volume.size_mm.norm()) {}

  [[nodiscard]] bool lit(const SurfacePoint& vertex, const Exposure& exposure) const {
    const Vec3 p_model = vertex.position_mm.cast<double>();
    // Fast rejection by a sphere around the volume: most vertices are far away.
    if ((p_model - exposure.T_model_sensor.translation()).squaredNorm() > reach_mm_ * reach_mm_) {
      return false;
    }
    const Vec3 p_sensor = exposure.T_model_sensor.inverse() * p_model;
    if (!sensor_.volume.contains(p_sensor, 0.0)) return false;
    const ProjectorModel& projector = sensor_.projector(exposure.pattern);
    const auto place = projector.slide_place(p_sensor);
    if (!place || !within_a_line(projector, *place)) return false;
    const auto pixel = sensor_.camera.project(p_sensor);
    if (!pixel || !sensor_.camera.sees(*pixel)) return false;
    return in_sight(p_model, vertex.normal.cast<double>(),
                    exposure.T_model_sensor * projector.center()) &&
           in_sight(p_model, vertex.normal.cast<double>(),
                    exposure.T_model_sensor * sensor_.camera.center());
  }

 private:
  [[nodiscard]] bool in_sight(const Vec3& p_model, const Vec3& normal, const Vec3& from) const {
    return normal.dot((from - p_model).normalized()) >= ViewOptions{}.min_cosine &&
           !scene_.blocked(p_model, normal, from);
  }

  const RayScene& scene_;
  const SensorModel& sensor_;
  double reach_mm_;
};

}  // namespace

std::vector<double> count_lit(const RayScene& scene, const SensorModel& sensor,
                              std::span<const Exposure> exposures, const Workers& workers) {
  const Illumination illumination(scene, sensor);
  const std::vector<SurfacePoint>& vertices = scene.mesh().vertices;
  std::vector<double> counts(vertices.size(), 0.0);
  workers.for_each(
      vertices.size(),
      [&](std::size_t i) {
        counts[i] = static_cast<double>(std::count_if(
            exposures.begin(), exposures.end(),
            [&](const Exposure& exposure) { return illumination.lit(vertices[i], exposure); }));
      },
      256);
  return counts;
}

}  // namespace flytri::simulated
