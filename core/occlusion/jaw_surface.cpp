#include "core/occlusion/jaw_surface.h"

#include <cmath>
#include <unordered_map>

namespace flytri::occlusion {
namespace {

/// Of each triangle, whether one of its corners lies on an edge that no other triangle shares.
std::vector<bool> triangles_at_rims(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> uses;
  const auto edge_key = [](std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
  };
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++uses[edge_key(t[k], t[(k + 1) % 3])];
  }
  std::vector<bool> is_rim_vertex(mesh.vertices.size(), false);
  for (const auto& [key, count] : uses) {
    if (count > 1) continue;
    is_rim_vertex[key >> 32U] = is_rim_vertex[key & 0xffffffffU] = true;
  }
  std::vector<bool> at_rim;
  at_rim.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    at_rim.push_back(is_rim_vertex[t[0]] || is_rim_vertex[t[1]] || is_rim_vertex[t[2]]);
  return at_rim;
}

/// The normal at a place of a triangle, between those of its corners.
Vec3 normal_at(const TriangleMesh& mesh, const Triangle& triangle, const Vec3f& p_mm) {
  const SurfacePoint &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]],
                     &c = mesh.vertices[triangle[2]];
  const Vec3f ab = b.position_mm - a.position_mm, ac = c.position_mm - a.position_mm;
  const Vec3f across = ab.cross(ac), ap = p_mm - a.position_mm;
  const float area = std::max(across.squaredNorm(), 1e-20F);
  const float share_b = ap.cross(ac).dot(across) / area, share_c = ab.cross(ap).dot(across) / area;
  const Vec3f normal =
      (1.0F - share_b - share_c) * a.normal + share_b * b.normal + share_c * c.normal;
  return normal.cast<double>().stableNormalized();
}

}  // namespace

JawSurface::JawSurface(const TriangleMesh& mesh)
    : mesh_(mesh), distance_(mesh), is_at_rim_(triangles_at_rims(mesh)) {}

std::optional<JawSurface::Foot> JawSurface::foot(const Vec3& p_mm, double limit_mm) const {
  const MeshDistance::Closest closest =
      distance_.closest(p_mm.cast<float>(), static_cast<float>(limit_mm));
  if (!std::isfinite(closest.distance_mm) || is_at_rim_[closest.triangle]) return std::nullopt;
  Foot foot;
  foot.point_mm = closest.point_mm.cast<double>();
  foot.normal = normal_at(mesh_, mesh_.triangles[closest.triangle], closest.point_mm);
  foot.offset_mm = foot.normal.dot(p_mm - foot.point_mm);
  return foot;
}

}  // namespace flytri::occlusion
