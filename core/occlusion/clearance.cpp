#include "core/occlusion/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/mesh_normals.h"

namespace flytri::occlusion {
namespace {

/// Jaws that meet face each other. With a larger cosine, it is the back of a thin part.
constexpr double kFacingCosine = 0.0;

}  // namespace

Clearance find_clearance(const TriangleMesh& jaw, const JawSurface& other,
                         const Isometry& T_other_jaw, double limit_mm, const Workers& workers) {
  Clearance clearance(jaw.vertices.size(), std::numeric_limits<float>::quiet_NaN());
  workers.for_each(
      jaw.vertices.size(),
      [&](std::size_t i) {
        const SurfacePoint& vertex = jaw.vertices[i];
        const Vec3 p_mm = T_other_jaw * vertex.position_mm.cast<double>();
        const auto foot = other.foot(p_mm, limit_mm);
        if (!foot) return;
        const Vec3 normal = T_other_jaw.linear() * vertex.normal.cast<double>();
        if (foot->normal.dot(normal) > kFacingCosine) return;
        const double away_mm = (p_mm - foot->point_mm).norm();
        clearance[i] = static_cast<float>(std::copysign(away_mm, foot->offset_mm));
      },
      256);
  return clearance;
}

Contact contact_of(const TriangleMesh& jaw, const Clearance& clearance, double contact_mm) {
  Contact contact;
  for (const Triangle& triangle : jaw.triangles) {
    double least_mm = 1e9;
    for (const std::uint32_t v : triangle) {
      // NaN does not compare.
      if (clearance[v] < least_mm) least_mm = clearance[v];
    }
    if (least_mm >= contact_mm) continue;
    contact.deepest_mm = std::max(contact.deepest_mm, -least_mm);
    const double area_mm2 = area_vector_mm2(jaw, triangle).norm();
    contact.area_mm2 += area_mm2;
    if (least_mm < -contact_mm) contact.penetration_area_mm2 += area_mm2;
  }
  return contact;
}

}  // namespace flytri::occlusion
