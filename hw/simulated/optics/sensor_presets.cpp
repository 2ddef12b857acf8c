/// @file  The two sensors of the paper, built from its numbers.
#include <cmath>
#include <numbers>

#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::simulated {
namespace {

// Paper, section "Physical Optimization": the interior of narrow gaps is visible up to about this
// angle.
constexpr double kTriangulationAngle_rad = 7.0 * std::numbers::pi / 180.0;

double baseline_mm(double distance_mm) { return distance_mm * std::tan(kTriangulationAngle_rad); }

}  // namespace

SensorLayout intraoral_layout() {
  return {.volume_mm = {20.0, 15.0, 15.0},
          .distance_mm = 80.0,
          .baseline_mm = baseline_mm(80.0),
          .focal_px = 3600.0,
          .focus_mm = 70.0,
          .camera_aperture_mm = 0.38,
          .projector_aperture_mm = 0.58,
          .line_width_mm = 0.085,
          .line_counts = {10, 7},
          .texture_focal_px = 4100.0,
          .dots = {.pitch_mm = 1.0, .diameter_mm = 0.5, .marker_diameter_mm = 0.8},
          .depth_sigma_mm = 0.03};
}

SensorLayout face_layout() {
  return {.volume_mm = {200.0, 150.0, 100.0},
          .distance_mm = 600.0,
          .baseline_mm = baseline_mm(600.0),
          .focal_px = 2720.0,
          .focus_mm = 535.0,
          .camera_aperture_mm = 2.0,
          .projector_aperture_mm = 3.2,
          .line_width_mm = 0.85,
          .line_counts = {12, 9},
          .texture_focal_px = 3100.0,
          .dots = {.pitch_mm = 10.0, .diameter_mm = 5.0, .marker_diameter_mm = 8.0},
          .depth_sigma_mm = 0.12};
}

SensorLayout layout_named(const std::string& name) {
  return is_face_sensor(name) ? face_layout() : intraoral_layout();
}

SensorModel intraoral_sensor() { return make_sensor(intraoral_layout()); }

SensorModel face_sensor() { return make_sensor(face_layout()); }

}  // namespace flytri::simulated
