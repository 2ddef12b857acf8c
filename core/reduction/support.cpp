#include "core/reduction/support.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/point_grid.h"

namespace flytri {
namespace {

/// How far across the normal a sample is compared with others, in cell widths: some lines of every
/// view that passed here, but no farther than a plane is a fair picture of the surface.
constexpr float kReachCells = 2.0F;

/// With more witnesses than this, only every second, third, ... view is heard: the verdict is as
/// sure, and the time grows with the samples, not with their square.
constexpr std::size_t kMaxWitnesses = 256;

/// What is known about the surface around one sample.
struct Votes {
  int agreeing_views = 0;    ///< other views with a sample near and at the same height
  int opposing_views = 0;    ///< other views with samples near, but all at another height
  int agreeing_samples = 0;  ///< of any view, itself included
};

/// Votes on the samples of one cell after another, with memory kept between them.
class Jury {
 public:
  Jury(std::span<const SurfaceSample> samples, const Cells& cells, const PointGrid& centers,
       const CellShape& shape, const SupportRule& rule)
      : samples_(samples), cells_(cells), centers_(centers), shape_(shape), rule_(rule) {}

  void judge(std::size_t cell, std::vector<Support>& support) {
    gather(cell);
    for (const std::uint32_t i : cells_.of(cell)) support[i] = verdict(vote(samples_[i]));
  }

 private:
  /// Collects the samples around a cell's axis, those of a view together.
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
      for (const std::uint32_t j : cells_.of(n.index)) witnesses_.push_back(j);
    }
    std::sort(witnesses_.begin(), witnesses_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return samples_[a].view != samples_[b].view ? samples_[a].view < samples_[b].view : a < b;
    });
    excuse_surplus_views();
    normal_ = mean_normal(center);
  }

  /// Keeps the witnesses of evenly chosen views if there are too many.
  void excuse_surplus_views() {
    const std::size_t step = witnesses_.size() / kMaxWitnesses + 1;
    if (step == 1) return;
    std::size_t kept = 0;
    std::size_t view_rank = 0;
    ViewIndex view = samples_[witnesses_.front()].view;
    for (const std::uint32_t w : witnesses_) {
      if (samples_[w].view != view) ++view_rank;
      view = samples_[w].view;
      if (view_rank % step == 0) witnesses_[kept++] = w;
    }
    witnesses_.resize(kept);
  }

  [[nodiscard]] Votes vote(const SurfaceSample& sample) const {
    const float variance = square(sigma_across_mm(sample, normal_));
    Votes votes;
    for (std::size_t w = 0; w < witnesses_.size();) {
      const ViewIndex view = samples_[witnesses_[w]].view;
      int near = 0;
      int agreeing = 0;
      for (; w < witnesses_.size() && samples_[witnesses_[w]].view == view; ++w) {
        const SurfaceSample& witness = samples_[witnesses_[w]];
        if (!is_beside(sample, witness)) continue;
        const float height = normal_.dot(witness.position_mm - sample.position_mm);
        const float limit2 =
            square(rule_.outlier_sigmas) * (variance + square(sigma_across_mm(witness, normal_)));
        ++near;
        if (height * height <= limit2) ++agreeing;
      }
      votes.agreeing_samples += agreeing;
      if (view == sample.view || near == 0) continue;
      ++(agreeing > 0 ? votes.agreeing_views : votes.opposing_views);
    }
    return votes;
  }

  [[nodiscard]] Support verdict(const Votes& votes) const {
    if (votes.agreeing_samples < rule_.min_support) return Support::kIsolated;
    // Two views may share one error, as at a depth step that both see from the same side.
    const bool outvoted =
        votes.opposing_views >= 2 && votes.opposing_views > 2 * votes.agreeing_views;
    return outvoted ? Support::kOutvoted : Support::kSupported;
  }

  [[nodiscard]] Vec3f mean_normal(const SurfaceSample& sample) const {
    Vec3f sum = sample.normal;
    for (const std::uint32_t w : witnesses_) {
      if (samples_[w].normal.dot(sample.normal) >= shape_.min_normal_cos) {
        sum += samples_[w].normal;
      }
    }
    return sum.normalized();
  }

  /// True if the witness tells something about the height of the surface at the sample.
  [[nodiscard]] bool is_beside(const SurfaceSample& sample, const SurfaceSample& witness) const {
    if (witness.normal.dot(normal_) < shape_.min_normal_cos) return false;
    const Vec3f d = witness.position_mm - sample.position_mm;
    const float along = d.dot(normal_);
    return std::abs(along) <= 2.0F * shape_.half_length_mm &&
           d.squaredNorm() - along * along <= square(kReachCells * shape_.width_mm);
  }

  static float square(float x) { return x * x; }

  std::span<const SurfaceSample> samples_;
  const Cells& cells_;
  const PointGrid& centers_;
  CellShape shape_;
  SupportRule rule_;
  std::vector<Neighbor> near_cells_;
  std::vector<std::uint32_t> witnesses_;  ///< samples around the cell, by view
  Vec3f normal_ = Vec3f::UnitZ();         ///< of the surface in the cell
};

}  // namespace

float sigma_across_mm(const SurfaceSample& sample, const Vec3f& normal) {
  const float along = sample.deviation_mm.dot(normal);
  return std::sqrt(along * along + 0.01F * sample.deviation_mm.squaredNorm());
}

std::vector<Support> find_support(std::span<const SurfaceSample> samples, const Cells& cells,
                                  const CellShape& shape, const SupportRule& rule,
                                  const Workers& workers) {
  std::vector<Vec3f> positions(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    positions[c] = samples[cells.centers[c]].position_mm;
  }
  const PointGrid centers(positions, 2.0F * shape.width_mm);
  std::vector<Support> support(samples.size(), Support::kSupported);
  constexpr std::size_t kBlock = 512;
  workers.for_each((cells.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    Jury jury(samples, cells, centers, shape, rule);
    const std::size_t end = std::min(cells.size(), (block + 1) * kBlock);
    for (std::size_t c = block * kBlock; c < end; ++c) jury.judge(c, support);
  });
  return support;
}

}  // namespace flytri
