#include "core/reduction/support.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/square.h"
#include "core/geometry/point_grid.h"
#include "core/reduction/sample_noise.h"
#include "core/reduction/wide_search.h"
#include "core/reduction/witness_table.h"

namespace flytri::reduction {
namespace {

/// Distance across the normal within which a sample is compared with others, in cell widths: far
/// enough for some lines of each view, near enough to treat the surface as a plane.
constexpr float kReachCells = 2.0F;

/// With more witnesses than this, only every second, third, ... view is used: the result is as
/// reliable, and the time is linear in the number of samples instead of quadratic.
constexpr std::size_t kMaxWitnesses = 128;

/// View and sample index in one number, for fast sorting.
using SampleOfView = std::uint64_t;
SampleOfView sample_of_view(ViewIndex view, std::uint32_t sample) {
  return (static_cast<SampleOfView>(static_cast<std::uint32_t>(view.value)) << 32U) | sample;
}
std::uint32_t view_of(SampleOfView w) { return static_cast<std::uint32_t>(w >> 32U); }
std::uint32_t sample_of(SampleOfView w) { return static_cast<std::uint32_t>(w); }

/// The cells around one cell after another.
class NearCells {
 public:
  /// @param centers_mm  kept by reference
  NearCells(std::span<const Vec3f> centers_mm, const PointGrid& grid, float reach_mm,
            float slack_mm)
      : centers_mm_(centers_mm), reach_mm_(reach_mm), search_(grid, reach_mm, slack_mm) {}

  /// Calls visit(cell, its center from there) for all centers within reach.
  template <typename Visit>
  void visit(const Vec3f& center_mm, const Visit& visit) {
    const bool is_new = search_.go_to(center_mm);
    const std::span<const Neighbor> found = search_.found();
    if (is_new) {
      found_mm_.clear();
      for (const Neighbor& n : found) found_mm_.push_back(centers_mm_[n.index]);
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Vec3f d = found_mm_[i] - center_mm;
      if (d.squaredNorm() <= square(reach_mm_)) visit(found[i].index, d);
    }
  }

 private:
  std::span<const Vec3f> centers_mm_;
  float reach_mm_;
  WideSearch search_;
  std::vector<Vec3f> found_mm_;  ///< centers of what it found
};

/// Judges the samples of one cell after another and reuses its buffers.
class SupportVoting {
 public:
  /// @param members  Cells::members with their views, in the same order
  SupportVoting(std::span<const SurfaceSample> samples, const Cells& cells,
                std::span<const SampleOfView> members, const NearCells& near_cells,
                const SupportRule& rule)
      : samples_(samples),
        cells_(cells),
        members_(members),
        near_cells_(near_cells),
        shape_(cells.shape),
        rule_(rule),
        limits_{square(kReachCells * shape_.width_mm), square(2.0F * shape_.half_length_mm),
                square(rule.outlier_sigmas)} {}

  void judge(std::size_t cell, std::vector<Support>& support) {
    gather(cell);
    center_mm_ = samples_[cells_.centers[cell]].position_mm;
    tabulate();
    for (const std::uint32_t i : cells_.of(cell))
      support[i] = verdict(table_.vote(in_cell(samples_[i]), limits_));
  }

 private:
  /// Collects the samples around a cell's axis, sorted by view.
  void gather(std::size_t cell) {
    const SurfaceSample& center = samples_[cells_.centers[cell]];
    const float across2_mm2 = square((kReachCells + 1.0F) * shape_.width_mm);
    witnesses_.clear();
    near_cells_.visit(center.position_mm, [&](std::uint32_t other, const Vec3f& d) {
      const float along = d.dot(center.normal);
      if (d.squaredNorm() - along * along > across2_mm2) return;
      const auto members = members_.subspan(cells_.starts[other], cells_.of(other).size());
      witnesses_.insert(witnesses_.end(), members.begin(), members.end());
    });
    limit_views();
    std::sort(witnesses_.begin(), witnesses_.end());
    normal_ = mean_normal(center);
  }

  /// If there are too many witnesses, keeps those of every second, third, ... view.
  void limit_views() {
    const std::size_t step = witnesses_.size() / kMaxWitnesses + 1;
    if (step == 1) return;
    views_.clear();
    for (const SampleOfView w : witnesses_) {
      if (view_of(w) >= is_used_.size()) is_used_.resize(view_of(w) + 1, 0);
      if (std::exchange(is_used_[view_of(w)], 1) == 0) views_.push_back(view_of(w));
    }
    std::sort(views_.begin(), views_.end());
    for (std::size_t i = 0; i < views_.size(); ++i) is_used_[views_[i]] = i % step == 0 ? 1 : 0;
    std::erase_if(witnesses_, [&](SampleOfView w) { return is_used_[view_of(w)] == 0; });
    for (const std::uint32_t view : views_) is_used_[view] = 0;
  }

  /// Fills the table with the witnesses on the cell's surface.
  void tabulate() {
    table_.clear();
    for (const SampleOfView w : witnesses_) {
      const SurfaceSample& sample = samples_[sample_of(w)];
      if (sample.normal.dot(normal_) < shape_.min_normal_cos) continue;
      table_.add(in_cell(sample));
    }
    table_.finish();
  }

  [[nodiscard]] Witness in_cell(const SurfaceSample& sample) const {
    const Vec3f p = sample.position_mm - center_mm_;
    return {p, normal_.dot(p), square(sigma_across_mm(sample, normal_)), sample.view};
  }

  [[nodiscard]] Support verdict(const Votes& votes) const {
    if (votes.agreeing_samples < rule_.min_support) return Support::kIsolated;
    // Two views may share one error, for example at a depth step seen from the same side.
    const bool outvoted =
        votes.opposing_views >= 2 && votes.opposing_views > 2 * votes.agreeing_views;
    return outvoted ? Support::kOutvoted : Support::kSupported;
  }

  [[nodiscard]] Vec3f mean_normal(const SurfaceSample& sample) const {
    Vec3f sum = sample.normal;
    for (const SampleOfView w : witnesses_) {
      const Vec3f& normal = samples_[sample_of(w)].normal;
      if (normal.dot(sample.normal) >= shape_.min_normal_cos) sum += normal;
    }
    return sum.normalized();
  }

  std::span<const SurfaceSample> samples_;
  const Cells& cells_;
  std::span<const SampleOfView> members_;
  NearCells near_cells_;
  CellShape shape_;
  SupportRule rule_;
  AgreementLimits limits_;
  std::vector<SampleOfView> witnesses_;  ///< samples around the cell, by view
  std::vector<std::uint32_t> views_;     ///< views of the witnesses, rising
  std::vector<char> is_used_;            ///< by view; all 0 between cells
  Vec3f normal_ = Vec3f::UnitZ();        ///< of the surface in the cell
  Vec3f center_mm_ = Vec3f::Zero();
  WitnessTable table_;  ///< witnesses on the surface of the cell
};

}  // namespace

Result<std::vector<Support>> find_support(std::span<const SurfaceSample> samples,
                                          const Cells& cells, const SupportRule& rule,
                                          const Workers& workers, const Progress& progress) {
  std::vector<Vec3f> positions(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    positions[c] = samples[cells.centers[c]].position_mm;
  }
  const CellShape& shape = cells.shape;
  const PointGrid grid(positions, 2.0F * shape.width_mm);
  const float reach_mm =
      std::hypot((kReachCells + 1.0F) * shape.width_mm, 2.0F * shape.half_length_mm);
  const NearCells near_cells(positions, grid, reach_mm, 2.0F * shape.width_mm);
  std::vector<SampleOfView> members(cells.members.size());
  std::transform(cells.members.begin(), cells.members.end(), members.begin(),
                 [&](std::uint32_t i) { return sample_of_view(samples[i].view, i); });
  std::vector<Support> support(samples.size(), Support::kSupported);
  constexpr std::size_t kWitnessBlock = 512;
  const auto judge_block = [&](std::size_t block) {
    SupportVoting voting(samples, cells, members, near_cells, rule);
    const std::size_t end = std::min(cells.size(), (block + 1) * kWitnessBlock);
    for (std::size_t c = block * kWitnessBlock; c < end; ++c) voting.judge(c, support);
  };
  const std::size_t blocks = (cells.size() + kWitnessBlock - 1) / kWitnessBlock;
  if (!workers.for_each_unless_cancelled(blocks, judge_block, progress)) return stopped();
  return support;
}

}  // namespace flytri::reduction
