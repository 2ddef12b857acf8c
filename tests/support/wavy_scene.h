/// @file  Views of an analytic surface, measured by ideal light sheets with known noise and pose.
#pragma once

#include <functional>

#include "core/base/random.h"
#include "core/geometry/view.h"

namespace flytri::testing {

/// z of the surface over (x, y), world frame, mm.
using HeightField = std::function<double(double, double)>;

/// Teeth-like waves with rounded cusps: about 2 mm high, 4 to 9 mm long.
[[nodiscard]] double cusped_height(double x, double y);

/// The intra-oral sensor as it measures: 10 vertical sheets over 20 mm, 7 horizontal over 15 mm.
struct SceneSensor {
  Vec3 volume_mm = Vec3(20, 15, 15);
  int vertical_lines = 10;
  int horizontal_lines = 7;
  int points_per_line = 450;
  double noise_mm = 0.03;          ///< along z
  double correlation_samples = 0;  ///< of the noise along a line, 0: white
};

/// What a sensor at T_world_sensor sees of the surface: points inside its volume, lit along z.
[[nodiscard]] View measure_scene(const HeightField& height, const SceneSensor& sensor,
                                 Pattern pattern, const Isometry& T_world_sensor, Random& random);

}  // namespace flytri::testing
