/// @file  Finds the line of the dental arch in the mesh of a jaw.
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
/// Casts rays from above along spokes around a hub near the open end; the high points of a spoke
/// are teeth.
/// @errors  kInsufficient: no ray hit the mesh.
[[nodiscard]] Result<std::vector<Vec3>> find_arch_line(const RayScene& scene, const JawAxes& axes);

}  // namespace flytri::simulated
