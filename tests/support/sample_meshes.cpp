#include "tests/support/sample_meshes.h"

#include <cmath>

#include "core/geometry/mesh_normals.h"

namespace flytri {
namespace {

// Adds two triangles for each cell of a grid with `columns` vertices per row.
void connect_grid(TriangleMesh& mesh, std::uint32_t rows, std::uint32_t columns) {
  for (std::uint32_t j = 0; j + 1 < rows; ++j)
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t corner = j * columns + i;
      mesh.triangles.push_back({corner, corner + columns, corner + 1});
      mesh.triangles.push_back({corner + 1, corner + columns, corner + columns + 1});
    }
}

}  // namespace

TriangleMesh height_field(const HeightFieldSize& size,
                          const std::function<double(double, double)>& depth) {
  const auto count =
      static_cast<std::uint32_t>(std::lround(2.0 * size.half_width_mm / size.step_mm)) + 1;
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j < count; ++j)
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = -size.half_width_mm + i * size.step_mm;
      const double y = -size.half_width_mm + j * size.step_mm;
      SurfacePoint vertex;
      vertex.position_mm = Vec3(x, y, depth(x, y)).cast<float>();
      mesh.vertices.push_back(vertex);
    }
  connect_grid(mesh, count, count);
  compute_vertex_normals(mesh);
  return mesh;
}

}  // namespace flytri
