#include "hw/simulated/optics/line_position.h"

#include <cmath>

namespace flytri::simulated {

LinePixel line_pixel(const SensorModel& sensor, const ProjectorModel& projector, double across,
                     double along, double z_mm) {
  const Vec3 center = projector.center();
  const Vec3 direction = projector.direction(across, along);
  const Vec3 p_sensor = center + (z_mm - center.z()) / direction.z() * direction;
  // A plane of the volume is in front of the camera.
  return to_line_pixel(projector.pattern, sensor.camera.project(p_sensor).value_or(Pixel{}));
}

double across_in_row(const SensorModel& sensor, const ProjectorModel& projector, double across,
                     double row_px, double z_mm) {
  // The secant method: the row is nearly a linear function of the place along the line.
  constexpr int kMaxSteps = 20;
  constexpr double kExactEnough_px = 1e-9;
  double a = -0.05;
  double b = 0.05;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double row_a = line_pixel(sensor, projector, across, a, z_mm).along_px;
    const double row_b = line_pixel(sensor, projector, across, b, z_mm).along_px;
    if (std::abs(row_b - row_a) < kExactEnough_px) break;
    const double next = a + (row_px - row_a) / (row_b - row_a) * (b - a);
    a = b;
    b = next;
  }
  return line_pixel(sensor, projector, across, b, z_mm).across_px;
}

}  // namespace flytri::simulated
