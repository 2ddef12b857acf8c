#include "tests/support/prepared_jaw.h"

#include <algorithm>

#include "assets/sample_jaw/dentition.h"
#include "core/geometry/append_mesh.h"
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
constexpr double kTakenOut_mm = 0.1;
constexpr float kSigma_mm = 0.012F;
/// Height of the flat top above the margin, before the scale.
constexpr float kTop_mm = 2.3F;

using Border = std::vector<std::uint32_t>;

std::uint32_t add_vertex(TriangleMesh& mesh, const Vec3f& p_mm) {
  SurfacePoint vertex;
  vertex.position_mm = p_mm;
  vertex.sigma_mm = kSigma_mm;
  mesh.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Its normal gets up.
void add_triangle(TriangleMesh& mesh, Triangle triangle) {
  if (area_vector_mm2(mesh, triangle).z() < 0.0) std::swap(triangle[0], triangle[1]);
  mesh.triangles.push_back(triangle);
}

/// A strip of triangles from a border to its points as `place` moves them.
template <typename Place>
Border add_strip(TriangleMesh& mesh, const Border& border, const Place& place) {
  Border next;
  for (const std::uint32_t v : border)
    next.push_back(add_vertex(mesh, place(mesh.vertices[v].position_mm)));
  for (std::size_t i = 0; i < border.size(); ++i) {
    const std::size_t k = (i + 1) % border.size();
    add_triangle(mesh, {border[i], border[k], next[i]});
    add_triangle(mesh, {border[k], next[k], next[i]});
  }
  return next;
}

/// Closes the upper border, and goes on from the lower one to the side: the gum.
void close(TriangleMesh& mesh) {
  auto borders = meshing::boundary_lines(mesh);
  std::sort(borders.begin(), borders.end(), [&](const Border& a, const Border& b) {
    return mesh.vertices[a.front()].position_mm.z() > mesh.vertices[b.front()].position_mm.z();
  });
  Border ring = borders.front();
  for (const float narrower : {0.8F, 0.7F, 0.5F}) {
    ring = add_strip(mesh, ring, [&](const Vec3f& p_mm) {
      return Vec3f(narrower * p_mm.x(), narrower * p_mm.y(), 0.5F * (p_mm.z() + kTop_mm));
    });
  }
  const std::uint32_t center = add_vertex(mesh, {0.0F, 0.0F, kTop_mm});
  for (std::size_t i = 0; i < ring.size(); ++i)
    add_triangle(mesh, {ring[i], ring[(i + 1) % ring.size()], center});
  ring = borders.back();
  for (int row = 0; row < 6; ++row) {
    const float up_mm = row < 3 ? 0.12F : -0.08F;
    ring = add_strip(mesh, ring, [&](const Vec3f& p_mm) {
      return Vec3f(1.06F * p_mm.x(), 1.06F * p_mm.y(), p_mm.z() + up_mm);
    });
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

}  // namespace

PreparedJaw prepared_jaw(const TriangleMesh& jaw, const Isometry& T_world_jaw) {
  const sample_jaw::Dentition teeth = sample_jaw::make_dentition(JawKind::kUpper, 1);
  const sample_jaw::PlacedTooth& tooth = teeth.teeth.at(kPreparedTooth);
  Preparation prepared = preparation({});
  close(prepared.mesh);
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
