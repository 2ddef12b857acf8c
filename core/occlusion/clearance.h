/// @file  How near two jaws are to each other when they are closed.
#pragma once

#include <vector>

#include "core/base/workers.h"
#include "core/occlusion/jaw_surface.h"

namespace flytri::occlusion {

/// Distances from a jaw to the other one, by vertex: negative inside it, mm. NaN: farther than the
/// limit, or beside what was scanned of it.
using Clearance = std::vector<float>;

/// @param T_other_jaw  from the frame of `jaw` to that of the other jaw
/// @param limit_mm     > 0. Only clearances up to this are found
[[nodiscard]] Clearance find_clearance(const TriangleMesh& jaw, const JawSurface& other,
                                       const Isometry& T_other_jaw, double limit_mm,
                                       const Workers& workers);

/// Where a jaw touches the other one.
struct Contact {
  double area_mm2 = 0.0;              ///< nearer than `contact_mm`, penetration included
  double penetration_area_mm2 = 0.0;  ///< where they penetrate by more than `contact_mm`
  double deepest_mm = 0.0;            ///< largest penetration, >= 0
};

/// @param clearance   of this jaw
/// @param contact_mm  > 0. Nearer than this is contact
[[nodiscard]] Contact contact_of(const TriangleMesh& jaw, const Clearance& clearance,
                                 double contact_mm);

}  // namespace flytri::occlusion
