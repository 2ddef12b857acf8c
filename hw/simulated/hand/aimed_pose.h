/// @file  From what a hand aims at to the pose of the sensor that it holds.
#pragma once

#include <optional>

#include "core/geometry/rigid.h"
#include "hw/device/steerable_hand.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// The sensor's origin at the target, its z away from `towards_sensor`, its x along `along`, which
/// must not be zero nor lie along `towards_sensor`.
/// @return T_model_sensor
[[nodiscard]] Isometry aimed_pose(const device::HandAim& aim);

/// How far along the sensor's z the surface lies from its origin, mm: in the middle between the
/// nearest and the farthest that fit into the volume together. None: there is no surface.
[[nodiscard]] std::optional<double> surface_depth(const RayScene& scene, const SensorModel& sensor,
                                                  const Isometry& T_model_sensor);

}  // namespace flytri::simulated
