/// @file  Finds the line along which the teeth of a jaw stand, from its mesh alone.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"
#include "hw/simulated/optics/ray_scene.h"

namespace flytri::simulated {

/// The axes of a jaw; orthonormal.
struct JawAxes {
  Vec3 right = Vec3::UnitX();
  Vec3 front = Vec3::UnitY();
  Vec3 up = Vec3::UnitZ();
};

/// Points on top of the dental arch at equal distances, from the -right end to the +right end.
/// Rays fall from above on spokes around the open end; on each spoke the high places are the teeth.
/// @errors  kInsufficient: the rays met nothing.
[[nodiscard]] Result<std::vector<Vec3>> find_arch_line(const RayScene& scene, const JawAxes& axes);

}  // namespace flytri::simulated
