/// @file  How fast the sensor moves at each pose of its path.
#pragma once

#include <span>
#include <vector>

#include "core/trajectory/path_fit.h"

namespace flytri::trajectory {

/// Longest time between two poses over which the velocity of the sensor is interpolated.
inline constexpr double kMotionGap_s = 0.15;

/// Velocity at pose i: the sensor of a time `dt_s` later has the pose
/// T_world_sensor * exp_twist(dt_s * velocity), to first order in dt_s. So it is a twist per
/// second, in the frame of the sensor: rad/s and mm/s.
///
/// The slope of a cubic through a pose, two before and two after. At 30 poses a second it loses
/// only 4 % of a tremor of 5 Hz. At an end of the path, or beside a gap, a parabola takes its
/// place. Zero if a pose has no neighbor.
/// @param path       by rising time, at distinct times
/// @param max_gap_s  > 0. Poses across a longer gap are not used together.
[[nodiscard]] Twist sensor_velocity(std::span<const TimedPose> path, std::size_t i,
                                    double max_gap_s = kMotionGap_s);
/// The same for all poses.
[[nodiscard]] std::vector<Twist> sensor_velocities(std::span<const TimedPose> path,
                                                   double max_gap_s = kMotionGap_s);

}  // namespace flytri::trajectory
