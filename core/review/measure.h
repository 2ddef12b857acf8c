/// @file  Points on a surface, and distances and angles between them, each with its standard
///          uncertainty.
#pragma once

#include "core/geometry/mesh_distance.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::review {

/// A measured number. The unit is that of the name that holds it.
struct Measured {
  double value = 0.0;
  double uncertainty = 0.0;  ///< standard uncertainty; infinite: unknown
};

struct MeasuredPoint {
  Vec3 position_mm = Vec3::Zero();
  double sigma_mm = 0.0;  ///< standard uncertainty in each direction; infinite: unknown
};

/// Whether any vertex has an uncertainty. Most formats do not keep it.
[[nodiscard]] bool has_uncertainty(const TriangleMesh& mesh);
/// Sets the uncertainty of all vertices that were measured; infinite: unknown.
void set_uncertainty(TriangleMesh& mesh, double sigma_mm);

/// The place of the surface that is nearest to `p_mm`. Its sigma is interpolated between the
/// corners, whose errors are taken to be the same one: that is the largest it can be.
/// @param distance  of the same mesh, which has triangles
[[nodiscard]] MeasuredPoint point_on_surface(const TriangleMesh& mesh, const MeshDistance& distance,
                                             const Vec3& p_mm);

/// The distance d of two points: u(d)^2 = sigma_a^2 + sigma_b^2. A mesh has the uncertainty along
/// the normal; here it is taken for that in every direction, so u(d) is rather too large.
/// @source  JCGM 100:2008 (GUM), equation (10): errors are small and independent.
[[nodiscard]] Measured distance_mm(const MeasuredPoint& a, const MeasuredPoint& b);

/// The angle at `apex` between the directions to a and b, rad, 0..pi. u^2 = sum of
/// sigma_i^2 |g_i|^2, with the gradient g_i of the angle by each place. Where two places are the
/// same, the angle is 0 and its uncertainty unknown.
/// @source  As distance_mm.
[[nodiscard]] Measured angle_rad(const MeasuredPoint& a, const MeasuredPoint& apex,
                                 const MeasuredPoint& b);

}  // namespace flytri::review
