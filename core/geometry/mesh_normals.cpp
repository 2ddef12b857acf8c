#include "core/geometry/mesh_normals.h"

namespace flytri {

void compute_vertex_normals(TriangleMesh& mesh) {
  std::vector<Vec3> sums(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& triangle : mesh.triangles) {
    const auto corner = [&](int i) {
      return mesh.vertices[triangle[i]].position_mm.cast<double>();
    };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const Vec3 doubled_area = (b - a).cross(c - a);
    for (const std::uint32_t vertex : triangle) sums[vertex] += doubled_area;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = sums[i].norm();
    mesh.vertices[i].normal =
        length > 0.0 ? Vec3f((sums[i] / length).cast<float>()) : Vec3f::UnitZ();
  }
}

}  // namespace flytri
