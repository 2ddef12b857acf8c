/// @file  Counts how often each place of a scanned mesh was lit by a line and seen by the camera.
#pragma once

#include <span>
#include <vector>

#include "core/base/workers.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Pattern and sensor pose of one exposure.
struct Exposure {
  Pattern pattern = Pattern::kVertical;
  Isometry T_model_sensor = Isometry::Identity();
};

/// For each vertex, the number of exposures in which it was within the width of a line, inside the
/// measurement volume, visible from camera and projector, and not at a too flat angle
/// (ViewOptions::min_cosine). Ignores motion during the exposure.
/// @return  one number per vertex of the scene's mesh
[[nodiscard]] std::vector<double> count_lit(const RayScene& scene, const SensorModel& sensor,
                                            std::span<const Exposure> exposures,
                                            const Workers& workers);

}  // namespace flytri::simulated
