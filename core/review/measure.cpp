#include "core/review/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flytri::review {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// A unit vector in the plane of u and v, perpendicular to u, on the side of v. Any perpendicular
/// if both lie on one line.
Vec3 across(const Vec3& u, const Vec3& v) {
  const Vec3 rest = v - v.dot(u) * u;
  return rest.norm() > 1e-9 ? rest.normalized() : u.unitOrthogonal();
}

/// Barycentric coordinates of a point in the plane of a triangle, each at least 0.
Vec3 shares_of(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area = std::max(normal.squaredNorm(), 1e-30);
  const double share_b = (p - a).cross(c - a).dot(normal) / area;
  const double share_c = (b - a).cross(p - a).dot(normal) / area;
  const Vec3 shares = Vec3(1.0 - share_b - share_c, share_b, share_c).cwiseMax(0.0);
  return shares / std::max(shares.sum(), 1e-30);
}

}  // namespace

bool has_uncertainty(const TriangleMesh& mesh) {
  return std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [](const SurfacePoint& vertex) {
    return vertex.sigma_mm > 0.0F && std::isfinite(vertex.sigma_mm);
  });
}

void set_uncertainty(TriangleMesh& mesh, double sigma_mm) {
  for (SurfacePoint& vertex : mesh.vertices) {
    if (std::isfinite(vertex.sigma_mm)) vertex.sigma_mm = static_cast<float>(sigma_mm);
  }
}

MeasuredPoint point_on_surface(const TriangleMesh& mesh, const MeshDistance& distance,
                               const Vec3& p_mm) {
  const MeshDistance::Closest closest = distance.closest(p_mm.cast<float>());
  MeasuredPoint point{closest.point_mm.cast<double>(), 0.0};
  const Triangle& t = mesh.triangles[closest.triangle];
  const auto corner = [&](std::size_t k) -> Vec3 {
    return mesh.vertices[t[k]].position_mm.cast<double>();
  };
  const Vec3 shares = shares_of(point.position_mm, corner(0), corner(1), corner(2));
  for (int k = 0; k < 3; ++k) {
    const double sigma_mm = mesh.vertices[t[static_cast<std::size_t>(k)]].sigma_mm;
    if (shares[k] > 0.0) point.sigma_mm += shares[k] * sigma_mm;
  }
  return point;
}

Measured distance_mm(const MeasuredPoint& a, const MeasuredPoint& b) {
  return {(a.position_mm - b.position_mm).norm(), std::hypot(a.sigma_mm, b.sigma_mm)};
}

Measured angle_rad(const MeasuredPoint& a, const MeasuredPoint& apex, const MeasuredPoint& b) {
  const Vec3 to_a = a.position_mm - apex.position_mm, to_b = b.position_mm - apex.position_mm;
  if (!(to_a.norm() > 0.0) || !(to_b.norm() > 0.0)) return {0.0, kUnknown};
  const Vec3 u = to_a.normalized(), v = to_b.normalized();
  const Vec3 gradient_a = -across(u, v) / to_a.norm();
  const Vec3 gradient_b = -across(v, u) / to_b.norm();
  const Vec3 gradient_apex = -(gradient_a + gradient_b);
  const Vec3 parts(a.sigma_mm * gradient_a.norm(), b.sigma_mm * gradient_b.norm(),
                   apex.sigma_mm * gradient_apex.norm());
  return {std::atan2(u.cross(v).norm(), u.dot(v)), parts.norm()};
}

}  // namespace flytri::review
