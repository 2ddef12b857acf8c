#include "tests/support/prepared_jaw.h"

#include <algorithm>
#include <array>

#include "assets/sample_jaw/dentition.h"
#include "core/geometry/mesh_normals.h"
#include "core/meshing/mesh_topology.h"
#include "tests/support/revolved.h"

namespace flytri::testing {
namespace {

/// A first molar, counted from one end of the arch.
constexpr std::size_t kPreparedTooth = 1;
/// As wide as the molar was; the margin lies so high above its neck.
const Vec3 kPreparationScale(1.15, 1.3, 1.15);
constexpr double kMarginHeight_mm = 1.6;
/// What is so near to the tooth that was there, or inside it, is taken out.
constexpr double kTakenOut_mm = 0.35;
constexpr float kSigma_mm = 0.012F;

/// Closes the upper border by a fan.
void add_top(TriangleMesh& mesh) {
  const auto height_mm = [&](const std::vector<std::uint32_t>& border) {
    return mesh.vertices[border.front()].position_mm.z();
  };
  const auto borders = meshing::boundary_lines(mesh);
  const auto& top =
      *std::max_element(borders.begin(), borders.end(),
                        [&](const auto& a, const auto& b) { return height_mm(a) < height_mm(b); });
  SurfacePoint middle;
  middle.position_mm = Vec3f(0.0F, 0.0F, height_mm(top) - 0.1F);
  middle.sigma_mm = mesh.vertices[top.front()].sigma_mm;
  const auto center = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(middle);
  for (std::size_t i = 0; i < top.size(); ++i) {
    Triangle fan = {top[i], top[(i + 1) % top.size()], center};
    if (area_vector_mm2(mesh, fan).z() < 0.0) std::swap(fan[0], fan[1]);
    mesh.triangles.push_back(fan);
  }
}

TriangleMesh without_tooth(TriangleMesh jaw, const sample_jaw::PlacedTooth& tooth,
                           const Isometry& T_jaw_world) {
  const auto is_tooth = [&](std::uint32_t v) {
    return tooth(T_jaw_world * jaw.vertices[v].position_mm.cast<double>()) < kTakenOut_mm;
  };
  std::erase_if(jaw.triangles, [&](const Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), is_tooth);
  });
  meshing::drop_unused_vertices(jaw);
  for (SurfacePoint& vertex : jaw.vertices) vertex.sigma_mm = kSigma_mm;
  return jaw;
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const Triangle& t : more.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace

PreparedJaw prepared_jaw(const TriangleMesh& jaw, const Isometry& T_world_jaw) {
  const sample_jaw::Dentition teeth = sample_jaw::make_dentition(JawKind::kUpper, 1);
  const sample_jaw::PlacedTooth& tooth = teeth.teeth.at(kPreparedTooth);
  Preparation prepared = preparation({});
  add_top(prepared.mesh);
  const auto in_world = [&](const Vec3& p_mm) -> Vec3 {
    const Vec3 p_tooth = kPreparationScale.cwiseProduct(p_mm) + kMarginHeight_mm * Vec3::UnitZ();
    return T_world_jaw * (tooth.origin_mm + tooth.R_tooth_jaw.transpose() * p_tooth);
  };
  for (SurfacePoint& vertex : prepared.mesh.vertices) {
    vertex.position_mm = in_world(vertex.position_mm.cast<double>()).cast<float>();
    vertex.color = {226, 214, 190};
  }
  // The frame of a tooth is mirrored on one side.
  if (tooth.R_tooth_jaw.determinant() < 0.0) {
    for (Triangle& triangle : prepared.mesh.triangles) std::swap(triangle[0], triangle[1]);
  }
  PreparedJaw made{without_tooth(jaw, tooth, T_world_jaw.inverse()), {}, in_world({0.0, 0.0, 2.5})};
  append(made.mesh, prepared.mesh);
  compute_vertex_normals(made.mesh);
  for (const Vec3& p_mm : prepared.margin_mm) made.margin_mm.push_back(in_world(p_mm));
  return made;
}

}  // namespace flytri::testing
