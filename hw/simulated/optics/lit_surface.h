/// @file  Which places of a scanned mesh could be measured: those on which a line lay in sight of
/// the camera.
#pragma once

#include <span>
#include <vector>

#include "core/base/workers.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// One exposure under a line pattern.
struct Exposure {
  Pattern pattern = Pattern::kVertical;
  Isometry T_model_sensor = Isometry::Identity();
};

/// The number of exposures in which each vertex was within the width of a line, inside the
/// measurement volume, in sight of camera and projector, and not too flat to be localized
/// (ViewOptions::min_cosine). Motion during the exposure is left out.
/// @returns parallel to the vertices of the scene's mesh.
[[nodiscard]] std::vector<double> count_lit(const RayScene& scene, const SensorModel& sensor,
                                            std::span<const Exposure> exposures,
                                            const Workers& workers);

}  // namespace flytri::simulated
