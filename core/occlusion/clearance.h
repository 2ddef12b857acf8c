/// @file  How near two jaws are to each other when they are closed.
#pragma once

#include <vector>

#include "core/base/workers.h"
#include "core/occlusion/jaw_surface.h"

namespace flytri::occlusion {

/// Distances from a jaw to the other one.
struct Clearance {
  /// By vertex: to the other jaw, negative inside it, mm. NaN: farther than the limit, or beside
  /// what was scanned of it.
  std::vector<float> distances_mm;
  double contact_area_mm2 = 0.0;  ///< where both are nearer than `contact_mm`, penetration included
  double penetration_area_mm2 = 0.0;  ///< where they penetrate by more than `contact_mm`
  double deepest_mm = 0.0;            ///< largest penetration, >= 0
};

/// @param T_other_jaw  from the frame of `jaw` to that of the other jaw
/// @param contact_mm   > 0. Nearer than this is contact
/// @param limit_mm     > contact_mm. Only clearances up to this are found
[[nodiscard]] Clearance find_clearance(const TriangleMesh& jaw, const JawSurface& other,
                                       const Isometry& T_other_jaw, double contact_mm,
                                       double limit_mm, const Workers& workers);

}  // namespace flytri::occlusion
