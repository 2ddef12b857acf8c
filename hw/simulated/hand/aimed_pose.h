/// @file  Computes the sensor pose from the target of the hand.
#pragma once

#include <optional>

#include "core/geometry/rigid.h"
#include "hw/device/steerable_hand.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// The pose with the sensor's origin at the target, its z opposite to `towards_sensor` and its x
/// along `along`, which must not be zero or parallel to `towards_sensor`.
/// @return  T_model_sensor
[[nodiscard]] Isometry aimed_pose(const device::HandAim& aim);

/// Depth of the surface along the sensor's z, mm: the middle between the nearest and the farthest
/// surface that fit into the volume together. None if there is no surface.
[[nodiscard]] std::optional<double> surface_depth(const RayScene& scene, const SensorModel& sensor,
                                                  const Isometry& T_model_sensor);

}  // namespace flytri::simulated
