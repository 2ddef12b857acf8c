/// @file  Pieces of a tooth in front of a virtual sensor, for flytri-lab enamel: a tilted plane,
/// and a cusp with a highlight near a line.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "hw/simulated/optics/sensor_model.h"
#include "hw/simulated/optics/tooth_light.h"

namespace flytri::lab {

/// The lines of the study.
inline constexpr Pattern kEnamelPattern = Pattern::kVertical;

/// Sensor frame.
struct EnamelScene {
  double z_mm = 0.0;  ///< depth in the volume
  /// Of a plane: turned about the lines; above 0 away from the projector.
  double tilt_degrees = 0.0;
  double radius_mm = 0.0;  ///< of a cusp; 0: a plane
  TriangleMesh mesh;
  /// The plane itself, or that which touches the cusp at the middle of its highlight.
  simulated::TangentPlane plane;

  [[nodiscard]] bool is_cusp() const { return radius_mm > 0.0; }
  /// How far a point is below the surface, along the normal.
  [[nodiscard]] double below_mm(const Vec3& p_sensor) const;
  /// Whether a point is near the middle of the plane or near the highlight.
  [[nodiscard]] bool is_measured(const Vec3& p_sensor) const;
};

/// 1 if the light of the vertical lines comes from the side of smaller x and columns, else -1.
[[nodiscard]] int away_from_projector(const simulated::SensorModel& sensor);

[[nodiscard]] EnamelScene tilted_plane(const simulated::SensorModel& sensor, double z_mm,
                                       double tilt_degrees);

/// A sphere. The middle of its highlight is beside the middle of a line.
/// @param offset_mm  of the highlight from the line, along x
[[nodiscard]] EnamelScene glossy_cusp(const simulated::SensorModel& sensor, double z_mm,
                                      double offset_mm);

/// The place of the line that is nearest to the middle of the volume on the slide.
[[nodiscard]] double middle_line(const simulated::ProjectorModel& projector, double z_mm);

}  // namespace flytri::lab
