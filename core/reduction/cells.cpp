#include "core/reduction/cells.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "core/geometry/point_grid.h"

namespace flytri {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Squared distance of `sample` from the axis of the cell around `center`; infinite outside of the
/// cell or on another surface.
float distance2_from_axis(const SurfaceSample& center, const SurfaceSample& sample,
                          const CellShape& shape) {
  const Vec3f d = sample.position_mm - center.position_mm;
  const float along = d.dot(center.normal);
  const float across2 = d.squaredNorm() - along * along;
  const bool inside = across2 < shape.width_mm * shape.width_mm &&
                      std::abs(along) <= shape.half_length_mm &&
                      sample.normal.dot(center.normal) >= shape.min_normal_cos;
  return inside ? across2 : std::numeric_limits<float>::infinity();
}

/// Cell centers under construction, in cubes of a hash table.
class GrowingCenters {
 public:
  GrowingCenters(std::span<const SurfaceSample> samples, const CellShape& shape)
      : samples_(samples), shape_(shape), heads_(std::size_t{1} << 20, kNone) {
    cube_mm_ = std::max(shape.half_length_mm, shape.width_mm);
  }

  /// Makes sample i a center unless it lies in the cell of one.
  void offer(std::uint32_t i) {
    if (!centers_.empty() && holds(last_, i)) return;
    const auto [x, y, z] = cube_of(samples_[i].position_mm);
    for (int cz = z - 1; cz <= z + 1; ++cz) {
      for (int cy = y - 1; cy <= y + 1; ++cy) {
        for (int cx = x - 1; cx <= x + 1; ++cx) {
          if (find_in_cube({cx, cy, cz}, i)) return;
        }
      }
    }
    last_ = static_cast<std::uint32_t>(centers_.size());
    std::uint32_t& head = heads_[slot_of({x, y, z})];
    next_.push_back(head);
    centers_.push_back(i);
    head = last_;
  }

  std::vector<std::uint32_t> take() { return std::move(centers_); }

 private:
  using Cube = std::array<int, 3>;

  Cube cube_of(const Vec3f& p) const {
    Cube cube;
    for (int axis = 0; axis < 3; ++axis) {
      cube[axis] = static_cast<int>(std::floor(p[axis] / cube_mm_));
    }
    return cube;
  }
  /// Cubes may share a slot: what is found there is tested anyway.
  std::size_t slot_of(const Cube& c) const {
    const std::uint64_t h = static_cast<std::uint32_t>(c[0]) * 0x9e3779b97f4a7c15ULL ^
                            static_cast<std::uint32_t>(c[1]) * 0xc2b2ae3d27d4eb4fULL ^
                            static_cast<std::uint32_t>(c[2]) * 0x165667b19e3779f9ULL;
    return static_cast<std::size_t>((h ^ (h >> 31)) & (heads_.size() - 1));
  }
  bool holds(std::uint32_t cell, std::uint32_t i) const {
    return std::isfinite(distance2_from_axis(samples_[centers_[cell]], samples_[i], shape_));
  }
  bool find_in_cube(const Cube& cube, std::uint32_t i) {
    for (std::uint32_t cell = heads_[slot_of(cube)]; cell != kNone; cell = next_[cell]) {
      if (!holds(cell, i)) continue;
      last_ = cell;  // the next sample is near and most likely in the same cell
      return true;
    }
    return false;
  }

  std::span<const SurfaceSample> samples_;
  CellShape shape_;
  float cube_mm_;
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> centers_;
  std::uint32_t last_ = 0;
};

/// The cell whose axis is nearest to each sample.
std::vector<std::uint32_t> nearest_cells(std::span<const SurfaceSample> samples,
                                         std::span<const std::uint32_t> centers,
                                         const CellShape& shape, const Workers& workers) {
  std::vector<Vec3f> positions(centers.size());
  for (std::size_t c = 0; c < centers.size(); ++c) {
    positions[c] = samples[centers[c]].position_mm;
  }
  const float reach_mm = std::hypot(shape.width_mm, shape.half_length_mm);
  const PointGrid grid(positions, 0.5F * reach_mm);
  std::vector<std::uint32_t> cell_of(samples.size(), kNone);
  constexpr std::size_t kBlock = 1024;
  const std::size_t blocks = (samples.size() + kBlock - 1) / kBlock;
  workers.for_each(blocks, [&](std::size_t block) {
    std::vector<Neighbor> near;
    const std::size_t end = std::min(samples.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) {
      grid.within(samples[i].position_mm, reach_mm, near);
      float best2 = std::numeric_limits<float>::infinity();
      for (const Neighbor& n : near) {
        const float d2 = distance2_from_axis(samples[centers[n.index]], samples[i], shape);
        if (d2 < best2 || (d2 == best2 && n.index < cell_of[i])) {
          best2 = d2;
          cell_of[i] = n.index;
        }
      }
    }
  });
  return cell_of;
}

}  // namespace

Cells divide_into_cells(std::span<const SurfaceSample> samples, const CellShape& shape,
                        const Workers& workers) {
  GrowingCenters growing(samples, shape);
  for (std::size_t i = 0; i < samples.size(); ++i) growing.offer(static_cast<std::uint32_t>(i));
  Cells cells;
  cells.centers = growing.take();
  const std::vector<std::uint32_t> cell_of = nearest_cells(samples, cells.centers, shape, workers);
  cells.starts.assign(cells.size() + 1, 0);
  for (const std::uint32_t c : cell_of) ++cells.starts[c + 1];
  std::partial_sum(cells.starts.begin(), cells.starts.end(), cells.starts.begin());
  std::vector<std::uint32_t> next(cells.starts.begin(), cells.starts.end() - 1);
  cells.members.resize(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    cells.members[next[cell_of[i]]++] = static_cast<std::uint32_t>(i);
  }
  return cells;
}

}  // namespace flytri
