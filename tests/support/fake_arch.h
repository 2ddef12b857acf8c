/// @file  A row of teeth as surfels: a ridge along a parabola.
#pragma once

#include "core/geometry/rigid.h"
#include "core/geometry/surfel.h"

namespace flytri::testing {

/// y = -bend x^2 / half length, a ridge with two flanks. Occlusal is +z, the lips lie towards +y.
[[nodiscard]] SurfelModel arch(double half_length_mm, double bend, const Isometry& T_world_arch);

/// Any orientation.
inline const Isometry kTurned =
    make_isometry(Eigen::Quaterniond(0.3, 0.8, -0.2, 0.4).normalized(), Vec3(20.0, -5.0, 3.0));

}  // namespace flytri::testing
