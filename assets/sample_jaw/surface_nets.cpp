#include "assets/sample_jaw/surface_nets.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry/mesh_normals.h"

namespace flytri::sample_jaw {
namespace {

using Cell = Eigen::Vector3i;

// Block sizes in cells. A block far from the surface is skipped; others are halved until the
// smallest size.
constexpr int kBlock = 16;
constexpr int kFinestBlock = 2;
// Largest gradient of a shape function; it may exceed 1.
constexpr double kMaxGrowth = 1.4;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Net {
 public:
  Net(const ImplicitShape& shape, const NetBox& box) : shape_(shape), box_(box) {
    corners_ = ((box.high_mm - box.low_mm) / box.cell_mm).array().ceil().cast<int>() + 1;
    const std::size_t count = static_cast<std::size_t>(corners_.x()) * corners_.y() * corners_.z();
    values_.assign(count, std::numeric_limits<float>::quiet_NaN());
    vertices_.assign(count, kNone);
  }

  TriangleMesh mesh() {
    for_each_step(kBlock, [&](const Cell& block) { sample_block(block, kBlock); });
    for_each_step(1, [&](const Cell& cell) {
      if (!std::isnan(values_[at(cell)])) add_vertex(cell);
    });
    for_each_step(1, [&](const Cell& cell) {
      if (std::isnan(values_[at(cell)])) return;
      for (int axis = 0; axis < 3; ++axis) add_quad(cell, axis);
    });
    compute_vertex_normals(mesh_);
    return std::move(mesh_);
  }

 private:
  template <typename Body>
  void for_each_step(int step, const Body& body) const {
    for (int z = 0; z < corners_.z(); z += step)
      for (int y = 0; y < corners_.y(); y += step)
        for (int x = 0; x < corners_.x(); x += step) body(Cell(x, y, z));
  }

  std::size_t at(const Cell& c) const {
    return (static_cast<std::size_t>(c.z()) * corners_.y() + c.y()) * corners_.x() + c.x();
  }
  bool inside(const Cell& c) const { return (c.array() < corners_.array()).all(); }
  Vec3 place(const Cell& c) const { return box_.low_mm + box_.cell_mm * c.cast<double>(); }

  void sample_block(const Cell& block, int size) {
    if (!inside(block)) return;
    const double reach_mm = 0.5 * std::sqrt(3.0) * (size + 1) * box_.cell_mm;
    const Vec3 middle = place(block) + Vec3::Constant(0.5 * size * box_.cell_mm);
    if (std::abs(shape_(middle)) > kMaxGrowth * reach_mm) return;
    if (size == kFinestBlock) return sample_corners(block, block.array() + size + 1);
    const int half = size / 2;
    for (int octant = 0; octant < 8; ++octant)
      sample_block(block + half * Cell(octant & 1, (octant >> 1) & 1, octant >> 2), half);
  }

  void sample_corners(const Cell& begin, const Cell& behind) {
    const Cell end = behind.cwiseMin(corners_);
    for (int z = begin.z(); z < end.z(); ++z)
      for (int y = begin.y(); y < end.y(); ++y)
        for (int x = begin.x(); x < end.x(); ++x) {
          float& value = values_[at({x, y, z})];
          if (std::isnan(value)) value = static_cast<float>(shape_(place({x, y, z})));
        }
  }

  // Whether all corners are known and the surface passes between them.
  bool crossed(const Cell& cell) const {
    int below = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const float value = values_[at(cell + Cell(corner & 1, (corner >> 1) & 1, corner >> 2))];
      if (std::isnan(value)) return false;
      below += value < 0.0F ? 1 : 0;
    }
    return below != 0 && below != 8;
  }

  void add_vertex(const Cell& cell) {
    if (!inside(cell + Cell::Ones()) || !crossed(cell)) return;
    Vec3 sum = Vec3::Zero();
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 4; ++side) {
        Cell a = cell;
        a[(axis + 1) % 3] += side & 1;
        a[(axis + 2) % 3] += side >> 1;
        const Cell b = a + Cell::Unit(axis);
        const float value_a = values_[at(a)];
        const float value_b = values_[at(b)];
        if ((value_a < 0.0F) == (value_b < 0.0F)) continue;
        sum += place(a) + box_.cell_mm * value_a / (value_a - value_b) * Vec3::Unit(axis);
        ++crossings;
      }
    vertices_[at(cell)] = static_cast<std::uint32_t>(mesh_.vertices.size());
    SurfacePoint vertex;
    const Vec3 position_mm = sum / crossings;
    vertex.position_mm = position_mm.cast<float>();
    mesh_.vertices.push_back(vertex);
  }

  // The four cells around one edge that the surface crosses.
  void add_quad(const Cell& a, int axis) {
    const Cell b = a + Cell::Unit(axis);
    const Cell left = Cell::Unit((axis + 1) % 3);
    const Cell down = Cell::Unit((axis + 2) % 3);
    if (!inside(b) || ((a - left - down).array() < 0).any()) return;
    const float value_a = values_[at(a)];
    const float value_b = values_[at(b)];
    if (std::isnan(value_a) || std::isnan(value_b) || (value_a < 0.0F) == (value_b < 0.0F)) return;
    std::array<std::uint32_t, 4> corner = {vertices_[at(a)], vertices_[at(a - left)],
                                           vertices_[at(a - left - down)], vertices_[at(a - down)]};
    for (const std::uint32_t index : corner)
      if (index == kNone) return;
    if (value_a > 0.0F) std::swap(corner[1], corner[3]);
    mesh_.triangles.push_back({corner[0], corner[1], corner[2]});
    mesh_.triangles.push_back({corner[0], corner[2], corner[3]});
  }

  const ImplicitShape& shape_;
  const NetBox& box_;
  Cell corners_;
  std::vector<float> values_;
  std::vector<std::uint32_t> vertices_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh surface_nets(const ImplicitShape& shape, const NetBox& box) {
  return Net(shape, box).mesh();
}

}  // namespace flytri::sample_jaw
