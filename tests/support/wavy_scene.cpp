#include "tests/support/wavy_scene.h"

#include <cmath>
#include <numbers>

namespace flytri::testing {
namespace {

/// z of the surface on the sensor's ray through (x, y) of its frame; Newton's method from z = 0.
double depth_on_ray(const HeightField& height, const Isometry& T_world_sensor, double x, double y) {
  const Vec3 ray = T_world_sensor.linear().col(2);
  double z = 0.0;
  for (int i = 0; i < 30; ++i) {
    const Vec3 p = T_world_sensor * Vec3(x, y, z);
    const double step = (height(p.x(), p.y()) - p.z()) / ray.z();
    z += 0.7 * step;
    if (std::abs(step) < 1e-10) break;
  }
  return z;
}

Profile measure_line(const HeightField& height, const SceneSensor& sensor, Pattern pattern, int n,
                     const Isometry& T_world_sensor, Random& random) {
  const bool vertical = pattern == Pattern::kVertical;
  const int lines = vertical ? sensor.vertical_lines : sensor.horizontal_lines;
  const double width = vertical ? sensor.volume_mm.x() : sensor.volume_mm.y();
  const double length = vertical ? sensor.volume_mm.y() : sensor.volume_mm.x();
  const double across = width * ((n + 0.5) / lines - 0.5);
  const double keep =
      sensor.correlation_samples > 0 ? std::exp(-1.0 / sensor.correlation_samples) : 0.0;

  Profile profile;
  profile.line = LineIndex(n);
  profile.sheet_normal = vertical ? Vec3::UnitX() : Vec3::UnitY();
  double noise = random.normal();
  for (int i = 0; i < sensor.points_per_line; ++i) {
    const double along = length * ((i + 0.5) / sensor.points_per_line - 0.5);
    const double x = vertical ? across : along;
    const double y = vertical ? along : across;
    const double z = depth_on_ray(height, T_world_sensor, x, y);
    noise = keep * noise + std::sqrt(1.0 - keep * keep) * random.normal();
    if (std::abs(z) > 0.5 * sensor.volume_mm.z()) continue;
    const auto sigma = static_cast<float>(sensor.noise_mm);
    profile.points.push_back(
        {Vec3(x, y, z + sensor.noise_mm * noise), Vec3f(0, 0, sigma), static_cast<float>(i)});
  }
  return profile;
}

}  // namespace

double cusped_height(double x, double y) {
  const double waves = 0.9 * std::sin(0.9 * x + 0.4) * std::cos(0.7 * y) +
                       0.5 * std::sin(1.7 * y - 0.8 * x) + 0.3 * std::cos(0.31 * x * y + x);
  const double cusp = 0.8 * std::abs(std::sin(0.45 * x + 0.2 * y));
  return waves - std::sqrt(cusp * cusp + 0.01);
}

View measure_scene(const HeightField& height, const SceneSensor& sensor, Pattern pattern,
                   const Isometry& T_world_sensor, Random& random) {
  View view;
  view.pattern = pattern;
  const int lines = pattern == Pattern::kVertical ? sensor.vertical_lines : sensor.horizontal_lines;
  for (int n = 0; n < lines; ++n) {
    Profile profile = measure_line(height, sensor, pattern, n, T_world_sensor, random);
    if (profile.points.size() >= 2) view.profiles.push_back(std::move(profile));
  }
  return view;
}

}  // namespace flytri::testing
