#include "core/geometry/mesh_normals.h"

namespace flytri {

Vec3 area_vector_mm2(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vec3 a = mesh.vertices[triangle[0]].position_mm.cast<double>();
  const Vec3 b = mesh.vertices[triangle[1]].position_mm.cast<double>();
  const Vec3 c = mesh.vertices[triangle[2]].position_mm.cast<double>();
  return 0.5 * (b - a).cross(c - a);
}

void compute_vertex_normals(TriangleMesh& mesh) {
  std::vector<Vec3> sums(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3 area = area_vector_mm2(mesh, triangle);
    for (const std::uint32_t vertex : triangle) sums[vertex] += area;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = sums[i].norm();
    mesh.vertices[i].normal =
        length > 0.0 ? Vec3f((sums[i] / length).cast<float>()) : Vec3f::UnitZ();
  }
}

}  // namespace flytri
