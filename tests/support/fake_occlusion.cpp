#include "tests/support/fake_occlusion.h"

#include <utility>

#include "core/occlusion/clearance.h"

namespace flytri::testing {
namespace {

constexpr double kOverlap_mm = 0.15, kLimit_mm = 3.0;

/// Mirrored at a plane in front of the chewing surfaces.
TriangleMesh mirrored(TriangleMesh mesh, const JawAxes& axes) {
  const Vec3f normal = axes.occlusal.cast<float>();
  const auto height_mm = static_cast<float>(axes.box_mm.max().z() - kOverlap_mm);
  for (SurfacePoint& vertex : mesh.vertices) {
    vertex.position_mm += 2.0F * (height_mm - normal.dot(vertex.position_mm)) * normal;
    vertex.normal -= 2.0F * normal.dot(vertex.normal) * normal;
  }
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

}  // namespace

std::shared_ptr<const ui::JawPair> fake_pair(const TriangleMesh& lower) {
  auto pair = std::make_shared<ui::JawPair>();
  const TriangleMesh upper = mirrored(lower, jaw_axes(lower));
  const Workers workers(1);
  pair->upper_axes = jaw_axes(upper);
  pair->first_lower = static_cast<std::uint32_t>(upper.vertices.size());
  TriangleMesh& both = pair->mesh.mesh;
  both = upper;
  both.vertices.insert(both.vertices.end(), lower.vertices.begin(), lower.vertices.end());
  for (Triangle triangle : lower.triangles) {
    for (std::uint32_t& vertex : triangle) vertex += pair->first_lower;
    both.triangles.push_back(triangle);
  }
  using occlusion::find_clearance;
  using occlusion::JawSurface;
  pair->clearance_mm =
      find_clearance(upper, JawSurface(lower), Isometry::Identity(), kLimit_mm, workers);
  const std::vector<float> below =
      find_clearance(lower, JawSurface(upper), Isometry::Identity(), kLimit_mm, workers);
  pair->clearance_mm.insert(pair->clearance_mm.end(), below.begin(), below.end());
  return pair;
}

}  // namespace flytri::testing
