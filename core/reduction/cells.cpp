#include "core/reduction/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/square.h"
#include "core/geometry/cell_key.h"
#include "core/geometry/point_grid.h"
#include "core/reduction/wide_search.h"

namespace flytri::reduction {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kBlock = 1024;

/// The search uses cells of half this size: in these, half of what the keys can tell apart.
constexpr float kMaxReach_cells = 0.25F * CellKey::kHighest;

/// Share of the total time of each part.
constexpr double kGrowingShare = 0.5, kNearestShare = 0.5;

/// Whether the cell around `center` holds a sample of the same surface.
bool holds(const SurfaceSample& center, const SurfaceSample& sample, const CellShape& shape) {
  const Vec3f d = sample.position_mm - center.position_mm;
  const float along = d.dot(center.normal);
  const float across2 = d.squaredNorm() - along * along;
  return across2 < square(shape.width_mm) && std::abs(along) <= shape.half_length_mm &&
         sample.normal.dot(center.normal) >= shape.min_normal_cos;
}

tl::unexpected<Error> too_far() {
  return fail(ErrorCode::kInconsistent,
              "measured points lie too far from the others; calibrate the sensor again");
}

/// Whether a grid of such cells reaches all samples.
bool are_within_reach(std::span<const SurfaceSample> samples, const CellShape& shape) {
  const float reach_mm = kMaxReach_cells * std::min(shape.width_mm, shape.half_length_mm);
  return std::all_of(samples.begin(), samples.end(), [&](const SurfaceSample& sample) {
    return (sample.position_mm.array().abs() <= reach_mm).all();
  });
}

/// Collects cell centers, in cubes of a hash table.
class GrowingCenters {
 public:
  GrowingCenters(std::span<const SurfaceSample> samples, const CellShape& shape)
      : samples_(samples), shape_(shape), heads_(std::size_t{1} << 20, kNone) {
    cube_mm_ = std::max(shape.half_length_mm, shape.width_mm);
  }

  /// Makes sample i a center unless it lies in an existing cell.
  void offer(std::uint32_t i) {
    if (!centers_.empty() && is_in(last_, i)) return;
    const CellKey cube = CellKey::at(samples_[i].position_mm, cube_mm_);
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (find_in_cube(cube.neighbor(dx, dy, dz), i)) return;
        }
      }
    }
    last_ = static_cast<std::uint32_t>(centers_.size());
    std::uint32_t& head = heads_[slot_of(cube)];
    next_.push_back(head);
    centers_.push_back(i);
    head = last_;
  }

  std::vector<std::uint32_t> take() { return std::move(centers_); }

 private:
  /// Cubes may share a slot, because the centers found there are tested anyway.
  std::size_t slot_of(CellKey cube) const { return hash_of(cube) & (heads_.size() - 1); }
  bool is_in(std::uint32_t cell, std::uint32_t i) const {
    return holds(samples_[centers_[cell]], samples_[i], shape_);
  }
  bool find_in_cube(CellKey cube, std::uint32_t i) {
    for (std::uint32_t cell = heads_[slot_of(cube)]; cell != kNone; cell = next_[cell]) {
      if (!is_in(cell, i)) continue;
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

/// Finds the center with the nearest axis.
class NearCenters {
 public:
  NearCenters(std::span<const SurfaceSample> samples, std::span<const std::uint32_t> centers,
              const PointGrid& grid, const CellShape& shape)
      : samples_(samples),
        centers_(centers),
        shape_(shape),
        search_(grid, std::hypot(shape.width_mm, shape.half_length_mm),
                kSlackCells * shape.width_mm) {}

  /// The nearest cell; among equally near ones the first. The sample must lie in a cell.
  std::uint32_t nearest_to(const SurfaceSample& sample) {
    if (search_.go_to(sample.position_mm)) gather();
    measure_distances(sample);
    const auto nearest = std::min_element(distances2_mm2_.begin(), distances2_mm2_.end());
    if (!(*nearest < std::numeric_limits<float>::infinity())) return kNone;
    return cells_[static_cast<std::size_t>(nearest - distances2_mm2_.begin())];
  }

 private:
  static constexpr float kSlackCells = 2.0F;

  void gather() {
    cells_.clear();
    for (const Neighbor& n : search_.found()) cells_.push_back(n.index);
    std::sort(cells_.begin(), cells_.end());
    for (int axis = 0; axis < 3; ++axis) {
      center_mm_[axis].resize(cells_.size());
      normal_[axis].resize(cells_.size());
      for (std::size_t i = 0; i < cells_.size(); ++i) {
        center_mm_[axis][i] = samples_[centers_[cells_[i]]].position_mm[axis];
        normal_[axis][i] = samples_[centers_[cells_[i]]].normal[axis];
      }
    }
    distances2_mm2_.resize(cells_.size());
  }

  /// For each cell: the squared distance of the sample from its axis; infinite if it is outside.
  void measure_distances(const SurfaceSample& sample) {
    const float *cx = center_mm_[0].data(), *cy = center_mm_[1].data(), *cz = center_mm_[2].data();
    const float *nx = normal_[0].data(), *ny = normal_[1].data(), *nz = normal_[2].data();
    const Vec3f p = sample.position_mm, n = sample.normal;
    const float width2 = square(shape_.width_mm), half_length = shape_.half_length_mm,
                min_cos = shape_.min_normal_cos;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const float dx = p.x() - cx[i], dy = p.y() - cy[i], dz = p.z() - cz[i];
      const float along = dx * nx[i] + dy * ny[i] + dz * nz[i];
      const float across2 = dx * dx + dy * dy + dz * dz - along * along;
      const float cosine = n.x() * nx[i] + n.y() * ny[i] + n.z() * nz[i];
      // Without branches, so that the compiler uses vector instructions.
      const int is_inside =
          int(across2 < width2) & int(std::abs(along) <= half_length) & int(cosine >= min_cos);
      distances2_mm2_[i] = is_inside != 0 ? across2 : std::numeric_limits<float>::infinity();
    }
  }

  std::span<const SurfaceSample> samples_;
  std::span<const std::uint32_t> centers_;
  CellShape shape_;
  WideSearch search_;
  std::vector<std::uint32_t> cells_;                      ///< rising
  std::array<std::vector<float>, 3> center_mm_, normal_;  ///< of these, by axis
  std::vector<float> distances2_mm2_;                     ///< of one sample from their axes
};

/// The cell whose axis is nearest to each sample.
Result<std::vector<std::uint32_t>> nearest_cells(std::span<const SurfaceSample> samples,
                                                 std::span<const std::uint32_t> centers,
                                                 const CellShape& shape, const Workers& workers,
                                                 const Progress& progress) {
  std::vector<Vec3f> positions(centers.size());
  for (std::size_t c = 0; c < centers.size(); ++c) {
    positions[c] = samples[centers[c]].position_mm;
  }
  const float reach_mm = std::hypot(shape.width_mm, shape.half_length_mm);
  const PointGrid grid(positions, 0.5F * reach_mm);
  std::vector<std::uint32_t> cell_of(samples.size(), kNone);
  const std::size_t blocks = (samples.size() + kBlock - 1) / kBlock;
  const auto search_block = [&](std::size_t block) {
    NearCenters near(samples, centers, grid, shape);
    const std::size_t end = std::min(samples.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) cell_of[i] = near.nearest_to(samples[i]);
  };
  if (!workers.for_each_unless_cancelled(blocks, search_block, progress)) return stopped();
  if (std::find(cell_of.begin(), cell_of.end(), kNone) != cell_of.end()) return too_far();
  return cell_of;
}

}  // namespace

Result<Cells> divide_into_cells(std::span<const SurfaceSample> samples, const CellShape& shape,
                                const Workers& workers, const Progress& progress) {
  if (!are_within_reach(samples, shape)) return too_far();
  GrowingCenters growing(samples, shape);
  const auto offer = [&](std::size_t i) { growing.offer(static_cast<std::uint32_t>(i)); };
  if (!for_each_in_order(samples.size(), offer, progress.part(kGrowingShare), kBlock)) {
    return stopped();
  }
  Cells cells;
  cells.shape = shape;
  cells.centers = growing.take();
  const auto cell_of =
      nearest_cells(samples, cells.centers, shape, workers, progress.part(kNearestShare));
  if (!cell_of) return tl::unexpected(cell_of.error());
  cells.starts.assign(cells.size() + 1, 0);
  for (const std::uint32_t c : *cell_of) ++cells.starts[c + 1];
  std::partial_sum(cells.starts.begin(), cells.starts.end(), cells.starts.begin());
  std::vector<std::uint32_t> next(cells.starts.begin(), cells.starts.end() - 1);
  cells.members.resize(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    cells.members[next[(*cell_of)[i]]++] = static_cast<std::uint32_t>(i);
  }
  return cells;
}

}  // namespace flytri::reduction
