#include "core/reduction/support.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/point_grid.h"
#include "core/reduction/sample_noise.h"

namespace flytri::reduction {
namespace {

/// Distance across the normal within which a sample is compared with others, in cell widths: far
/// enough for some lines of each view, near enough to treat the surface as a plane.
constexpr float kReachCells = 2.0F;

/// With more witnesses than this, only every second, third, ... view is used: the result is as
/// reliable, and the time is linear in the number of samples instead of quadratic.
constexpr std::size_t kMaxWitnesses = 128;

/// Votes of the views on one sample.
struct Votes {
  int agreeing_views = 0;    ///< other views with a sample near and at the same height
  int opposing_views = 0;    ///< other views with samples near, but all at another height
  int agreeing_samples = 0;  ///< samples of any view, including itself
};

/// The witnesses of a cell (samples of the surface around it), one array for each field, so that
/// many are compared at once. Positions are relative to the cell's center, heights along its
/// normal.
struct WitnessTable {
  std::vector<float> x_mm, y_mm, z_mm, height_mm, variance_mm2;
  std::vector<std::uint32_t> slots;  ///< index of its view in `views`
  std::vector<ViewIndex> views;      ///< rising

  void clear() {
    for (auto* field : {&x_mm, &y_mm, &z_mm, &height_mm, &variance_mm2}) field->clear();
    slots.clear();
    views.clear();
  }
  /// Add witnesses view by view.
  void add(const Vec3f& p, float height, float variance, ViewIndex view) {
    x_mm.push_back(p.x()), y_mm.push_back(p.y()), z_mm.push_back(p.z());
    height_mm.push_back(height), variance_mm2.push_back(variance);
    if (views.empty() || views.back() != view) views.push_back(view);
    slots.push_back(static_cast<std::uint32_t>(views.size() - 1));
  }
};

/// Statement of a witness on a sample, as bits.
enum Statement : std::uint8_t { kFar = 0, kNear = 1, kAgrees = 2 };

/// View and sample index in one number, for fast sorting.
using Witness = std::uint64_t;
Witness witness_of(ViewIndex view, std::uint32_t sample) {
  return (static_cast<Witness>(static_cast<std::uint32_t>(view.value)) << 32U) | sample;
}
std::uint32_t view_of(Witness w) { return static_cast<std::uint32_t>(w >> 32U); }
std::uint32_t sample_of(Witness w) { return static_cast<std::uint32_t>(w); }

/// Judges the samples of one cell after another and reuses its buffers.
class SupportVoting {
 public:
  /// @param members  Cells::members as witnesses, in the same order
  SupportVoting(std::span<const SurfaceSample> samples, const Cells& cells,
                std::span<const Witness> members, const PointGrid& centers, const SupportRule& rule)
      : samples_(samples),
        cells_(cells),
        members_(members),
        centers_(centers),
        shape_(cells.shape),
        rule_(rule) {}

  void judge(std::size_t cell, std::vector<Support>& support) {
    gather(cell);
    tabulate(samples_[cells_.centers[cell]].position_mm);
    for (const std::uint32_t i : cells_.of(cell)) support[i] = verdict(vote(samples_[i]));
  }

 private:
  /// Collects the samples around a cell's axis, sorted by view.
  void gather(std::size_t cell) {
    const SurfaceSample& center = samples_[cells_.centers[cell]];
    const float across_mm = (kReachCells + 1.0F) * shape_.width_mm;
    centers_.within(center.position_mm, std::hypot(across_mm, 2.0F * shape_.half_length_mm),
                    near_cells_);
    witnesses_.clear();
    for (const Neighbor& n : near_cells_) {
      const Vec3f d = samples_[cells_.centers[n.index]].position_mm - center.position_mm;
      const float along = d.dot(center.normal);
      if (d.squaredNorm() - along * along > across_mm * across_mm) continue;
      const auto members = members_.subspan(cells_.starts[n.index], cells_.of(n.index).size());
      witnesses_.insert(witnesses_.end(), members.begin(), members.end());
    }
    limit_views();
    std::sort(witnesses_.begin(), witnesses_.end());
    normal_ = mean_normal(center);
  }

  /// If there are too many witnesses, keeps those of every second, third, ... view.
  void limit_views() {
    const std::size_t step = witnesses_.size() / kMaxWitnesses + 1;
    if (step == 1) return;
    views_.clear();
    for (const Witness w : witnesses_) {
      if (view_of(w) >= is_used_.size()) is_used_.resize(view_of(w) + 1, 0);
      if (std::exchange(is_used_[view_of(w)], 1) == 0) views_.push_back(view_of(w));
    }
    std::sort(views_.begin(), views_.end());
    for (std::size_t i = 0; i < views_.size(); ++i) is_used_[views_[i]] = i % step == 0 ? 1 : 0;
    std::erase_if(witnesses_, [&](Witness w) { return is_used_[view_of(w)] == 0; });
    for (const std::uint32_t view : views_) is_used_[view] = 0;
  }

  /// Fills the table with the witnesses on the cell's surface.
  void tabulate(const Vec3f& center_mm) {
    center_mm_ = center_mm;
    table_.clear();
    for (const Witness w : witnesses_) {
      const SurfaceSample& witness = samples_[sample_of(w)];
      if (witness.normal.dot(normal_) < shape_.min_normal_cos) continue;
      const Vec3f p = witness.position_mm - center_mm;
      table_.add(p, normal_.dot(p), square(sigma_across_mm(witness, normal_)), witness.view);
    }
    statements_.resize(table_.slots.size());
  }

  /// Fills statements_: whether each witness of the table is near the sample and agrees with its
  /// height.
  void compare(const SurfaceSample& sample) {
    const Vec3f p = sample.position_mm - center_mm_;
    const float height = normal_.dot(p), variance = square(sigma_across_mm(sample, normal_));
    const float sigmas2 = square(rule_.outlier_sigmas);
    const float across2 = square(kReachCells * shape_.width_mm);
    const float along2 = square(2.0F * shape_.half_length_mm);
    const auto &x = table_.x_mm, &y = table_.y_mm, &z = table_.z_mm, &h = table_.height_mm,
               &v = table_.variance_mm2;
    for (std::size_t w = 0; w < statements_.size(); ++w) {
      const float rise2 = square(h[w] - height);
      const float distance2 = square(x[w] - p.x()) + square(y[w] - p.y()) + square(z[w] - p.z());
      const int near = int(rise2 <= along2) & int(distance2 - rise2 <= across2);
      const int agrees = near & int(rise2 <= sigmas2 * (variance + v[w]));
      statements_[w] = static_cast<std::uint8_t>(near * kNear + agrees * kAgrees);
    }
  }

  [[nodiscard]] Votes vote(const SurfaceSample& sample) {
    compare(sample);
    Votes votes;
    view_statements_.assign(table_.views.size(), kFar);
    for (std::size_t w = 0; w < statements_.size(); ++w) {
      view_statements_[table_.slots[w]] |= statements_[w];
      votes.agreeing_samples += statements_[w] / kAgrees;
    }
    const auto own = std::lower_bound(table_.views.begin(), table_.views.end(), sample.view);
    if (own != table_.views.end() && *own == sample.view) {
      view_statements_[static_cast<std::size_t>(own - table_.views.begin())] = kFar;
    }
    for (const std::uint8_t statement : view_statements_) {
      votes.agreeing_views += statement / kAgrees;
      votes.opposing_views += statement == kNear ? 1 : 0;
    }
    return votes;
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
    for (const Witness w : witnesses_) {
      const Vec3f& normal = samples_[sample_of(w)].normal;
      if (normal.dot(sample.normal) >= shape_.min_normal_cos) sum += normal;
    }
    return sum.normalized();
  }

  static float square(float x) { return x * x; }

  std::span<const SurfaceSample> samples_;
  const Cells& cells_;
  std::span<const Witness> members_;
  const PointGrid& centers_;
  CellShape shape_;
  SupportRule rule_;
  std::vector<Neighbor> near_cells_;
  std::vector<Witness> witnesses_;    ///< samples around the cell, by view
  std::vector<std::uint32_t> views_;  ///< views of the witnesses, rising
  std::vector<char> is_used_;         ///< by view; all 0 between cells
  Vec3f normal_ = Vec3f::UnitZ();     ///< of the surface in the cell
  Vec3f center_mm_ = Vec3f::Zero();
  WitnessTable table_;                         ///< witnesses on the surface of the cell
  std::vector<std::uint8_t> statements_;       ///< of each witness of the table on one sample
  std::vector<std::uint8_t> view_statements_;  ///< of each view of the table, all its statements
                                               ///< combined
};

}  // namespace

Result<std::vector<Support>> find_support(std::span<const SurfaceSample> samples,
                                          const Cells& cells, const SupportRule& rule,
                                          const Workers& workers, const Progress& progress) {
  std::vector<Vec3f> positions(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    positions[c] = samples[cells.centers[c]].position_mm;
  }
  const PointGrid centers(positions, 2.0F * cells.shape.width_mm);
  std::vector<Witness> members(cells.members.size());
  std::transform(cells.members.begin(), cells.members.end(), members.begin(),
                 [&](std::uint32_t i) { return witness_of(samples[i].view, i); });
  std::vector<Support> support(samples.size(), Support::kSupported);
  constexpr std::size_t kWitnessBlock = 512;
  const auto judge_block = [&](std::size_t block) {
    SupportVoting voting(samples, cells, members, centers, rule);
    const std::size_t end = std::min(cells.size(), (block + 1) * kWitnessBlock);
    for (std::size_t c = block * kWitnessBlock; c < end; ++c) voting.judge(c, support);
  };
  const std::size_t blocks = (cells.size() + kWitnessBlock - 1) / kWitnessBlock;
  if (!workers.for_each_unless_cancelled(blocks, judge_block, progress)) return stopped();
  return support;
}

}  // namespace flytri::reduction
