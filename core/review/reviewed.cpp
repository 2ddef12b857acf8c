#include "core/review/reviewed.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/geometry/mesh_normals.h"
#include "core/meshing/mesh_topology.h"

namespace flytri::review {

TriangleMesh made_ready(const TriangleMesh& model) {
  TriangleMesh mesh = meshing::welded(model);
  meshing::repair_manifold(mesh);
  compute_vertex_normals(mesh);
  return mesh;
}

bool mark_unknown_uncertainty(TriangleMesh& mesh) {
  if (has_uncertainty(mesh)) return true;
  set_uncertainty(mesh, std::numeric_limits<double>::infinity());
  return false;
}

ReviewedNumber reviewed_number(const TriangleMesh& mesh, const MeshDistance& distance,
                               std::span<const Vec3> points_mm) {
  ReviewedNumber number;
  for (const Vec3& p_mm : points_mm)
    number.points.push_back(point_on_surface(mesh, distance, p_mm));
  const std::vector<MeasuredPoint>& at = number.points;
  number.measured = at.size() == 2 ? distance_mm(at[0], at[1]) : angle_rad(at[0], at[1], at[2]);
  return number;
}

Result<ReviewedSection> reviewed_section(const TriangleMesh& mesh, const Plane& plane,
                                         std::span<const Vec3> points_mm) {
  auto outlines = section_of(mesh, plane);
  if (!outlines) return tl::unexpected(outlines.error());
  ReviewedSection section{plane, *std::move(outlines), {}, {}};
  for (const Vec3& p_mm : points_mm)
    section.places.push_back(nearest_place(section.outlines, p_mm));
  if (section.places.empty()) return section;
  const auto part = part_between(section.outlines, section.places[0], section.places[1]);
  if (part) section.along_mm = length_mm(*part);
  return section;
}

Result<ReviewedUndercut> reviewed_undercut(const TriangleMesh& mesh, const UndercutRequest& request,
                                           const Workers& workers) {
  ReviewedUndercut reviewed;
  if (request.around_mm) {
    auto part = part_around(mesh, *request.around_mm, request.radius_mm);
    if (!part) return tl::unexpected(part.error());
    reviewed.part = *std::move(part);
  } else {
    reviewed.part = mesh;
  }
  if (request.axis) {
    reviewed.axis = request.axis->stableNormalized();
  } else {
    const auto found = find_insertion_axis(reviewed.part, mean_normal(reviewed.part), {}, workers);
    if (!found) return tl::unexpected(found.error());
    reviewed.axis = found->axis;
    reviewed.found = *found;
  }
  auto undercut = find_undercut(reviewed.part, reviewed.axis, {}, workers);
  if (!undercut) return tl::unexpected(undercut.error());
  reviewed.undercut = *std::move(undercut);
  return reviewed;
}

std::vector<float> vertex_depths_mm(const ReviewedUndercut& reviewed) {
  std::vector<float> deepest_mm(reviewed.part.vertices.size(), 0.0F);
  for (std::size_t t = 0; t < reviewed.part.triangles.size(); ++t) {
    if (reviewed.undercut.hidden_share[t] < 0.5F) continue;
    for (const std::uint32_t v : reviewed.part.triangles[t])
      deepest_mm[v] = std::max(deepest_mm[v], reviewed.undercut.depth_mm[t]);
  }
  return deepest_mm;
}

}  // namespace flytri::review
