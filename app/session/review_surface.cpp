#include "app/session/review_surface.h"

#include <array>
#include <limits>
#include <map>
#include <utility>

namespace flytri::session {
namespace {

TriangleMesh ready_mesh(const reconstruct::FinishedScan& scan) {
  TriangleMesh mesh = review::made_ready(scan.surface.mesh);
  review::mark_unknown_uncertainty(mesh);
  return mesh;
}

using Place = std::array<float, 3>;

Place place_of(const SurfacePoint& vertex) {
  return {vertex.position_mm.x(), vertex.position_mm.y(), vertex.position_mm.z()};
}

/// The shown model is cut into charts: its vertices are found by where they are.
std::vector<float> depths_on_model(const TriangleMesh& model,
                                   const review::ReviewedUndercut& reviewed) {
  constexpr float kNotLookedAt = -1.0F;
  const std::vector<float> depths_mm = review::vertex_depths_mm(reviewed);
  std::map<Place, float> depth_at;
  Eigen::AlignedBox3f box_mm;
  for (const Triangle& triangle : reviewed.part.triangles) {
    for (const std::uint32_t v : triangle) {
      const SurfacePoint& vertex = reviewed.part.vertices[v];
      depth_at.try_emplace(place_of(vertex), depths_mm[v]);
      box_mm.extend(vertex.position_mm);
    }
  }
  std::vector<float> by_vertex(model.vertices.size(), kNotLookedAt);
  for (std::size_t i = 0; i < model.vertices.size(); ++i) {
    if (!box_mm.contains(model.vertices[i].position_mm)) continue;
    const auto found = depth_at.find(place_of(model.vertices[i]));
    if (found != depth_at.end()) by_vertex[i] = found->second;
  }
  return by_vertex;
}

Vec3 middle_of(const TriangleMesh& part) {
  Eigen::AlignedBox3d box_mm;
  for (const Triangle& triangle : part.triangles) {
    for (const std::uint32_t v : triangle)
      box_mm.extend(part.vertices[v].position_mm.cast<double>());
  }
  return box_mm.center();
}

}  // namespace

ReviewSurface::ReviewSurface(std::shared_ptr<const reconstruct::FinishedScan> scan)
    : scan_(std::move(scan)), mesh_(ready_mesh(*scan_)), distance_(mesh_) {}

std::vector<review::Measured> ReviewSurface::distances_mm(
    const std::vector<io::Measurement>& measurements) const {
  constexpr double kOff_mm = 1.0;
  std::vector<review::Measured> distances;
  for (const io::Measurement& measurement : measurements) {
    const std::array points_mm = {measurement.from_mm, measurement.to_mm};
    const auto is_on = [&](const Vec3& p_mm) {
      return distance_.is_within(p_mm.cast<float>(), kOff_mm);
    };
    if (is_on(points_mm[0]) && is_on(points_mm[1])) {
      distances.push_back(review::reviewed_number(mesh_, distance_, points_mm).measured);
    } else {
      distances.push_back(
          {(points_mm[0] - points_mm[1]).norm(), std::numeric_limits<double>::infinity()});
    }
  }
  return distances;
}

Result<ui::UndercutMap> ReviewSurface::undercut(const review::UndercutRequest& request,
                                                const Workers& workers) const {
  auto reviewed = review::reviewed_undercut(mesh_, request, workers);
  if (!reviewed) return tl::unexpected(reviewed.error());
  std::vector<float> depths_mm = depths_on_model(scan_->model.mesh, *reviewed);
  const Vec3 middle_mm = middle_of(reviewed->part);
  return ui::UndercutMap{*std::move(reviewed), std::move(depths_mm), middle_mm, request.radius_mm};
}

}  // namespace flytri::session
