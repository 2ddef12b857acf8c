/// @file  Rigid motions `p_a = T_a_b * p_b`, and small motions as twists.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>

namespace flytri {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Isometry = Eigen::Isometry3d;
/// A small rigid motion: rotation vector (rad) in the head, translation (mm) in the tail.
using Twist = Eigen::Matrix<double, 6, 1>;

/// The rigid motion of a twist: rotation exp(head), then translation tail (not the SE(3) screw).
[[nodiscard]] Isometry exp_twist(const Twist& twist);

/// The twist of a rigid motion: inverse of exp_twist for rotations below pi.
[[nodiscard]] Twist log_twist(const Isometry& T_a_b);

/// A pose between T_a_b (share 0) and T_a_c (share 1): slerp of the rotation, linear in the
/// translation.
[[nodiscard]] Isometry interpolate(const Isometry& T_a_b, const Isometry& T_a_c, double share);

/// Rotation angle of a rigid motion in rad, 0..pi.
[[nodiscard]] double rotation_angle(const Isometry& T_a_b);

/// T_a_b from a rotation (normalized here) and a translation in mm.
[[nodiscard]] Isometry make_isometry(const Eigen::Quaterniond& q_a_b, const Vec3& t_a_b_mm);

}  // namespace flytri
