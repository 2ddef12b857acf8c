/// @file  Soft tissue that passes in front of the sensor: a tongue, a cheek or a finger.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "hw/simulated/optics/sensor_model.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {

/// Rounded, rigid bodies. One after the other enters the measurement volume from a side and leaves
/// it again.
class PassingTissue {
 public:
  /// @param share  of the time, 0..0.5; 0: never
  PassingTissue(const SensorPath& path, const SensorModel& sensor, double share,
                std::uint64_t seed);

  /// The tissue in front of the sensor at this time, model frame; empty if there is none.
  [[nodiscard]] TriangleMesh at(double time_s) const;

 private:
  struct Visit {
    double begin_s = 0.0;
    Isometry T_model_sensor = Isometry::Identity();  ///< in the middle of the visit
    Vec3 outside_mm = Vec3::Zero();  ///< center of the body at the start and the end
    Vec3 inside_mm = Vec3::Zero();   ///< in the middle
    Vec3 half_axes_mm = Vec3::Ones();
  };
  std::vector<Visit> visits_;
};

}  // namespace flytri::simulated
