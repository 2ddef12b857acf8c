/// @file  Simulates views of an analytic surface, with ideal light sheets and known noise and pose.
#pragma once

#include <functional>

#include "core/base/random.h"
#include "core/geometry/view.h"

namespace flytri::testing {

/// z of the surface over (x, y), world frame, mm.
using HeightField = std::function<double(double, double)>;

/// Teeth-like waves with rounded cusps: about 2 mm high, 4 to 9 mm long.
[[nodiscard]] double cusped_height(double x, double y);

/// Simplified intra-oral sensor: 10 vertical light sheets over 20 mm, 7 horizontal ones over 15 mm.
struct SceneSensor {
  Vec3 volume_mm = Vec3(20, 15, 15);
  int vertical_lines = 10;
  int horizontal_lines = 7;
  int points_per_line = 450;
  double noise_mm = 0.03;          ///< along z
  double correlation_samples = 0;  ///< correlation of the noise along a line; 0: white
};

/// The view of a sensor at T_world_sensor: the surface points on light sheets inside its volume;
/// the light comes along z.
[[nodiscard]] View measure_scene(const HeightField& height, const SceneSensor& sensor,
                                 Pattern pattern, const Isometry& T_world_sensor, Random& random);

}  // namespace flytri::testing
