#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/check_options.h"
#include "core/base/random.h"
#include "core/refinement/refine.h"
#include "core/registration/overlap_grid.h"

namespace flytri::refinement {
namespace {

/// Registers the views of a scan one after the other.
class MetaviewRefiner {
 public:
  MetaviewRefiner(const std::vector<AlignedView>& views, const MetaviewRefineOptions& options)
      : options_(options), grid_(prepare(views)) {
    options_.align.coarse_pairs = 0;
    for (std::size_t v = 0; v < placed_.size(); ++v) grid_.add(extent(v));
  }

  /// Registers every view once. @returns the RMS motion of the views, mm.
  double round(Random& random) {
    std::vector<std::size_t> order(placed_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      std::swap(order[i], order[i + random.below(order.size() - i)]);
    }
    double squares = 0.0;
    for (const std::size_t v : order) squares += std::pow(register_view(v), 2);
    return std::sqrt(squares / static_cast<double>(placed_.size()));
  }

  [[nodiscard]] const Isometry& pose(std::size_t v) const { return poses_[v]; }
  [[nodiscard]] double radius_mm() const { return radius_mm_; }
  /// False if no view was registered to another one.
  [[nodiscard]] bool moved_any() const { return moved_any_; }

 private:
  /// Fills poses_ and placed_. @returns the side of the grid's cells.
  double prepare(const std::vector<AlignedView>& views) {
    for (const AlignedView& view : views) {
      poses_.push_back(view.T_world_sensor);
      placed_.push_back(registration::prepare_view(*view.view).moved(view.T_world_sensor));
      radius_mm_ = std::max(radius_mm_, placed_.back().radius_mm);
    }
    return radius_mm_;
  }

  [[nodiscard]] registration::ViewExtent extent(std::size_t v) const {
    return {placed_[v].center_mm, placed_[v].line_direction, poses_[v].linear().col(2),
            placed_[v].radius_mm};
  }

  double register_view(std::size_t v) {
    std::vector<const registration::PreparedView*> metaview;
    for (const registration::Overlap& overlap : grid_.overlapping(extent(v))) {
      if (overlap.view != v) metaview.push_back(&placed_[overlap.view]);
    }
    // The source is in the world frame, so the result is a correction of its pose.
    options_.align.seed = ++seed_;
    const auto found =
        registration::align_to_metaview(placed_[v], metaview, Isometry::Identity(), options_.align);
    // With drift in the metaview, no pose fits well. The result still improves the pose.
    if (!found || (!found->aligned() && found->outcome != registration::AlignOutcome::kPoorFit))
      return 0.0;
    moved_any_ = true;
    const Isometry& T_world_was = found->T_target_source;
    poses_[v] = T_world_was * poses_[v];
    placed_[v] = placed_[v].moved(T_world_was);
    grid_.move(v, extent(v));
    return found->moved_mm;
  }

  MetaviewRefineOptions options_;
  std::vector<Isometry> poses_;
  std::vector<registration::PreparedView> placed_;
  double radius_mm_ = 1e-6;  ///< largest radius of a view
  bool moved_any_ = false;
  std::uint64_t seed_ = 0;
  registration::OverlapGrid grid_;
};

}  // namespace

Result<void> MetaviewRefineOptions::validate() const {
  return OptionCheck("MetaviewRefineOptions")
      .nested(align)
      .at_least("max_rounds", max_rounds, 1)
      .positive("convergence_share", convergence_share)
      .result();
}

Result<MetaviewRefinement> refine_by_metaviews(std::vector<AlignedView>& views,
                                               const MetaviewRefineOptions& options,
                                               const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (views.empty()) return fail(ErrorCode::kInsufficient, "there is no view to optimize");
  MetaviewRefiner refiner(views, options);
  MetaviewRefinement result;
  Random random(options.seed);
  for (int i = 0; i < options.max_rounds; ++i) {
    if (progress.cancelled()) return stopped();
    result.moved_mm.push_back(refiner.round(random));
    progress.advance(1.0 / options.max_rounds);
    if (!refiner.moved_any()) return result;
    result.outcome = RefineOutcome::kStepLimit;
    if (result.moved_mm.back() < options.convergence_share * refiner.radius_mm()) {
      result.outcome = RefineOutcome::kConverged;
      break;
    }
  }
  // The first view keeps its pose.
  const Isometry T_old_new = views.front().T_world_sensor * refiner.pose(0).inverse();
  for (std::size_t v = 0; v < views.size(); ++v) {
    const Isometry T = T_old_new * refiner.pose(v);
    views[v].T_world_sensor = make_isometry(Eigen::Quaterniond(T.linear()), T.translation());
  }
  return result;
}

}  // namespace flytri::refinement
