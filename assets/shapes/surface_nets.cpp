#include "assets/shapes/surface_nets.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/geometry/mesh_normals.h"
#include "core/geometry/surface_net.h"

namespace flytri::shapes {
namespace {

using Cell = Eigen::Vector3i;

// Block sizes in cells. A block far from the surface is skipped; others are halved until the
// smallest size.
constexpr int kBlock = 16;
constexpr int kFinestBlock = 2;
// Largest gradient of a shape function; it may exceed 1.
constexpr double kMaxGrowth = 1.4;

class Net {
 public:
  Net(const ImplicitShape& shape, const NetBox& box) : shape_(shape), box_(box) {
    corners_ = ((box.high_mm - box.low_mm) / box.cell_mm).array().ceil().cast<int>() + 1;
  }

  TriangleMesh mesh() {
    sample();
    place_vertices();
    NetEdges edges(grid_, cells_);
    for (std::size_t i = 0; i < grid_.corners.size(); ++i) {
      edges.from_corner(i, [&](const std::array<std::uint32_t, 4>& ring) {
        mesh_.triangles.push_back({ring[2], ring[3], ring[0]});
        mesh_.triangles.push_back({ring[2], ring[0], ring[1]});
      });
    }
    compute_vertex_normals(mesh_);
    return std::move(mesh_);
  }

 private:
  Vec3 place(CellKey corner) const {
    return box_.low_mm + box_.cell_mm * Vec3(grid_number(corner, 0), grid_number(corner, 1),
                                             grid_number(corner, 2));
  }

  // Values at all corners near the surface.
  void sample() {
    for (int z = 0; z < corners_.z(); z += kBlock)
      for (int y = 0; y < corners_.y(); y += kBlock)
        for (int x = 0; x < corners_.x(); x += kBlock) choose_corners({x, y, z}, kBlock);
    sort_unique(grid_.corners);
    for (const CellKey corner : grid_.corners)
      grid_.values.push_back(static_cast<float>(shape_(place(corner))));
  }

  void choose_corners(const Cell& block, int size) {
    if ((block.array() >= corners_.array()).any()) return;
    const double reach_mm = 0.5 * std::sqrt(3.0) * (size + 1) * box_.cell_mm;
    const Vec3 middle = place(grid_key(block.x(), block.y(), block.z())) +
                        Vec3::Constant(0.5 * size * box_.cell_mm);
    if (std::abs(shape_(middle)) > kMaxGrowth * reach_mm) return;
    if (size == kFinestBlock) return add_corners(block, block.array() + size + 1);
    const int half = size / 2;
    for (int octant = 0; octant < 8; ++octant)
      choose_corners(block + half * Cell(octant & 1, (octant >> 1) & 1, octant >> 2), half);
  }

  void add_corners(const Cell& begin, const Cell& behind) {
    const Cell end = behind.cwiseMin(corners_);
    for (int z = begin.z(); z < end.z(); ++z)
      for (int y = begin.y(); y < end.y(); ++y)
        for (int x = begin.x(); x < end.x(); ++x) grid_.corners.push_back(grid_key(x, y, z));
  }

  // A cell is named by its lowest corner.
  void place_vertices() {
    CornerReader reader(grid_);
    for (const CellKey cell : grid_.corners) {
      const std::array<float, 8> values = reader.around(cell);
      if (!is_crossed(values)) continue;
      Vec3 sum = Vec3::Zero();
      int crossings = 0;
      for_each_crossing(values, [&](int k, int l, double share) {
        const Vec3 a = place(corner_of(cell, k));
        sum += a + share * (place(corner_of(cell, l)) - a);
        ++crossings;
      });
      SurfacePoint vertex;
      vertex.position_mm = Vec3(sum / crossings).cast<float>();
      mesh_.vertices.push_back(vertex);
      cells_.push_back(cell);
    }
  }

  const ImplicitShape& shape_;
  const NetBox& box_;
  Cell corners_;
  CornerValues grid_;
  std::vector<CellKey> cells_;  // with a vertex each
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh surface_nets(const ImplicitShape& shape, const NetBox& box) {
  return Net(shape, box).mesh();
}

}  // namespace flytri::shapes
