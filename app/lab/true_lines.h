/// @file  Which line of a virtual sensor truly lights a place of an image.
#pragma once

#include <optional>

#include "core/localization/line_trace.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::lab {

/// The truth of one image, by ray casting; motion during the exposure is ignored. Refers to scene
/// and sensor.
class TrueLines {
 public:
  TrueLines(const simulated::RayScene& scene, const simulated::SensorModel& sensor, Pattern pattern,
            const Isometry& T_model_sensor)
      : scene_(scene), sensor_(sensor), pattern_(pattern), T_model_sensor_(T_model_sensor) {}

  /// True if the surface at the sample is inside the measurement volume.
  [[nodiscard]] bool is_in_volume(const localization::LineSample& sample) const;

  /// True if no line is nearer to the surface at the sample than this one. At a depth step, the
  /// surface within half a line width counts, too.
  [[nodiscard]] bool is(LineIndex line, const localization::LineSample& sample) const;

  /// The line nearest to the surface that a pixel sees; none if it sees no surface.
  [[nodiscard]] std::optional<LineIndex> line_at(const LinePixel& pixel) const;

 private:
  /// The surface that a pixel sees, sensor frame.
  [[nodiscard]] std::optional<Vec3> surface_at(const LinePixel& pixel) const;

  const simulated::RayScene& scene_;
  const simulated::SensorModel& sensor_;
  Pattern pattern_;
  Isometry T_model_sensor_;
};

}  // namespace flytri::lab
