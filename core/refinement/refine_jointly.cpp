#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/check_options.h"
#include "core/geometry/decompositions.h"
#include "core/refinement/bordered_system.h"
#include "core/refinement/joint_equations.h"
#include "core/refinement/refine.h"
#include "core/refinement/sheet_shift.h"

namespace flytri::refinement {
namespace {

/// A step must not raise the robust spread by more than this.
constexpr double kMaxWorsening = 1.02;
/// The same while the readout still changes. This moves the points, so the spread may rise at
/// first.
constexpr double kMaxUnsettledWorsening = 1.2;
/// Shares of time: of a step in the remaining time (the number of steps is unknown); of the
/// surfaces in a step; of the sums in the pose update.
constexpr double kStepShare = 0.25, kSurfaceShare = 0.5, kSumShare = 0.4;

/// Standard uncertainties of where a projector is that was knocked.
constexpr double kProjectorShift_mm = 0.1, kProjectorTurn_rad = 2e-3;

/// Standard uncertainty of a readout of which nothing is known.
constexpr double kReadout_s = 0.1;
/// A solution is not converged while the readout changes by more than this.
constexpr double kSettledReadout_s = 1e-4;
/// Enough views to tell the readout, which is the same for all.
constexpr std::size_t kMostReadoutViews = 300;
/// Enough data to tell how the whole scan has moved.
constexpr std::size_t kMostMotionData = 20000;

Matrix6 projector_prior() {
  Twist prior;
  prior << Vec3::Constant(1.0 / kProjectorTurn_rad), Vec3::Constant(1.0 / kProjectorShift_mm);
  return prior.cwiseAbs2().asDiagonal();
}

/// The view as it is seen with its projector moved.
std::shared_ptr<const View> moved_view(const View& view, const Twist& motion,
                                       const Vec3& p_camera_mm) {
  auto moved = std::make_shared<View>(view);
  for (Profile& profile : moved->profiles) {
    for (ProfilePoint& point : profile.points) {
      point.position_mm = seen_with(motion, point.position_mm, profile.sheet_normal, p_camera_mm);
    }
  }
  return moved;
}

/// Joint optimization of one scan.
class JointRefiner {
 public:
  JointRefiner(std::vector<AlignedView>& views, const JointRefineOptions& options,
               const Workers& workers, const Progress& progress)
      : views_(views),
        options_(options),
        workers_(workers),
        progress_(progress),
        equations_(views, options, workers) {
    for (const AlignedView& view : views) now_.poses.push_back(view.T_world_sensor);
  }

  /// Solves for the motions of projectors, too.
  void find_motions(std::span<const ProjectorMotion> motions, const Vec3& p_camera_mm);
  Result<Refinement> run();
  /// Solves for the readout of a rolling shutter, too.
  void find_readout(const trajectory::RowShare& row_share, double from_s);
  /// One solution from the present poses, which do not change.
  Result<Readout> estimate();
  [[nodiscard]] Readout readout() const { return {now_.readout_s, readout_uncertainty_s_}; }
  /// By projector, as in find_motions().
  [[nodiscard]] const std::vector<Twist>& motions() const { return now_.motions; }

 private:
  struct State {
    std::vector<Isometry> poses;
    std::vector<Twist> motions;  ///< of the projectors, sensor frame
    double readout_s = 0.0;      ///< of a rolling shutter
  };

  [[nodiscard]] Result<BorderedStep> solve(const FittedSurfaces& step,
                                           std::span<const Vec3> centers_mm,
                                           const Progress& progress);
  void place_data();
  /// Moves all poses by one Gauss-Newton step. False if canceled; then no pose moved.
  [[nodiscard]] bool move(const FittedSurfaces& step, const Progress& progress);
  void rate_views(const FittedSurfaces& step);
  void fix_world();
  /// Ends a run that was canceled with the best poses found so far.
  [[nodiscard]] tl::unexpected<Error> stop_at(State best);
  void go_to(State state);

  std::vector<AlignedView>& views_;
  const JointRefineOptions& options_;
  const Workers& workers_;
  const Progress& progress_;
  State now_;
  JointEquations equations_;
  double readout_uncertainty_s_ = 0.0;
  double readout_change_s_ = 0.0;  ///< by the last step
  Refinement result_;
};

void JointRefiner::find_motions(std::span<const ProjectorMotion> motions, const Vec3& p_camera_mm) {
  MovedProjectors projectors{{}, motions.size(), p_camera_mm};
  for (const AlignedView& view : views_) {
    const auto fits = [&](const ProjectorMotion& m) { return m.concerns(*view.view); };
    const auto found = std::find_if(motions.begin(), motions.end(), fits);
    projectors.of_view.emplace_back();
    if (found != motions.end())
      projectors.of_view.back() = static_cast<std::size_t>(found - motions.begin());
  }
  equations_.set_projectors(std::move(projectors));
  for (const ProjectorMotion& m : motions) now_.motions.push_back(m.motion);
  place_data();
}

void JointRefiner::find_readout(const trajectory::RowShare& row_share, double from_s) {
  equations_.set_rolling_shutter(row_share);
  now_.readout_s = from_s;
  place_data();
}

/// Puts the data where they are seen with the present motions or readout.
void JointRefiner::place_data() {
  if (equations_.has_rolling_shutter())
    equations_.move_rows(velocities_of(views_, now_.poses), now_.readout_s);
  if (!now_.motions.empty()) equations_.move_projectors(now_.motions);
}

void JointRefiner::go_to(State state) {
  now_ = std::move(state);
  place_data();
}

Result<BorderedStep> JointRefiner::solve(const FittedSurfaces& step, std::span<const Vec3> centers,
                                         const Progress& progress) {
  ReducedSystem system({centers.begin(), centers.end()});
  const double step_mm = options_.step_share * equations_.cell_mm();
  Twist prior;
  prior << Vec3::Constant(1.0 / (step_mm / equations_.mean_radius_mm())),
      Vec3::Constant(1.0 / step_mm);
  for (std::size_t v = 0; v < now_.poses.size(); ++v) {
    system.add_view(v, prior.cwiseAbs2().asDiagonal(), Twist::Zero());
  }
  system.reserve(equations_.count_views_of_cells(step));
  BorderedSystem bordered(system, now_.poses.size(), equations_.group_count(),
                          equations_.group_size());
  for (std::size_t k = 0; k < equations_.projectors().count; ++k) {
    bordered.add_prior(k, projector_prior(), now_.motions[k]);
  }
  if (equations_.has_rolling_shutter()) {
    bordered.add_prior(0, Eigen::MatrixXd::Constant(1, 1, 1.0 / (kReadout_s * kReadout_s)),
                       Eigen::VectorXd::Constant(1, now_.readout_s));
  }
  const auto add = [&](std::size_t, std::span<const CellViewShare> shares) {
    bordered.add_cell(shares);
  };
  if (!equations_.sum_cells(step, now_.poses, centers, progress.part(kSumShare), add))
    return stopped();
  system.finish(workers_);
  if (progress.cancelled()) return stopped();
  return bordered.solve(workers_, progress.part(1.0 - kSumShare));
}

bool JointRefiner::move(const FittedSurfaces& step, const Progress& progress) {
  const std::vector<Vec3> centers = equations_.view_centers_mm(now_.poses);
  const auto x = solve(step, centers, progress);
  if (!x) return false;
  for (std::size_t v = 0; v < now_.poses.size(); ++v) {
    const Twist twist = x->views.segment<6>(first_entry_of(v));
    const Eigen::Translation3d to_center(-centers[v]);
    now_.poses[v] = to_center.inverse() * exp_twist(twist) * to_center * now_.poses[v];
  }
  for (std::size_t k = 0; k < equations_.projectors().count; ++k) {
    now_.motions[k] += x->shared.segment<6>(first_entry_of(k));
  }
  if (equations_.has_rolling_shutter()) {
    readout_change_s_ = x->shared[0];
    readout_uncertainty_s_ = std::sqrt(x->shared_covariance(0, 0));
    now_.readout_s += readout_change_s_;
  }
  place_data();
  return true;
}

void JointRefiner::rate_views(const FittedSurfaces& step) {
  result_.views.assign(now_.poses.size(), {});
  std::vector<std::size_t> inliers(now_.poses.size(), 0);
  const double limit = options_.tukey_sigmas * step.spread;
  for (std::size_t c = 0; c < step.cells.size(); ++c) {
    for (std::size_t k = 0; k < step.residuals[c].size(); ++k) {
      const ResidualSize& r = step.residuals[c][k];
      if (!r.usable) continue;
      const std::size_t v = equations_.data()[step.cells[c].data[k]].view.at();
      ++result_.views[v].count;
      if (std::abs(r.residual_mm) >= limit * r.sigma_mm) continue;
      ++inliers[v];
      result_.views[v].rms_mm += r.residual_mm * r.residual_mm;
    }
  }
  for (std::size_t v = 0; v < now_.poses.size(); ++v) {
    ViewResidual& view = result_.views[v];
    if (view.count == 0) continue;
    view.inlier_share = static_cast<double>(inliers[v]) / static_cast<double>(view.count);
    view.rms_mm = std::sqrt(view.rms_mm / std::max<double>(1.0, static_cast<double>(inliers[v])));
  }
}

/// The surface as a whole stays where it was: a single view is too weak a hold. What a moved
/// projector showed was in a wrong place.
void JointRefiner::fix_world() {
  bool some_unmoved = false;
  for (std::size_t v = 0; v < now_.poses.size(); ++v)
    some_unmoved |= !equations_.projectors().of(v);
  std::vector<Vec3> new_mm, old_mm;
  const std::size_t stride = 1 + equations_.data().size() / kMostMotionData;
  for (std::size_t i = 0; i < equations_.data().size(); i += stride) {
    const Datum& datum = equations_.data()[i];
    if (some_unmoved && equations_.projectors().of(datum.view.at())) continue;
    new_mm.push_back(now_.poses[datum.view.at()] * datum.position_mm);
    old_mm.push_back(views_[datum.view.at()].T_world_sensor * datum.position_mm);
  }
  const Isometry T_old_new = best_motion(new_mm, old_mm);
  for (std::size_t v = 0; v < now_.poses.size(); ++v) {
    // Normalize the rotation after many products.
    const Isometry T = T_old_new * now_.poses[v];
    views_[v].T_world_sensor = make_isometry(Eigen::Quaterniond(T.linear()), T.translation());
  }
}

tl::unexpected<Error> JointRefiner::stop_at(State best) {
  go_to(std::move(best));
  fix_world();
  return stopped();
}

Result<Readout> JointRefiner::estimate() {
  if (equations_.empty()) return Readout{0.0, kReadout_s};
  const auto step = equations_.fit_surfaces(now_.poses, progress_.part(kSurfaceShare));
  if (!step) return tl::unexpected(step.error());
  const auto x =
      solve(*step, equations_.view_centers_mm(now_.poses), progress_.part(1.0 - kSurfaceShare));
  if (!x) return tl::unexpected(x.error());
  const double factor = equations_.step_factor(*step);
  return Readout{now_.readout_s + factor * x->shared[0],
                 factor * std::sqrt(x->shared_covariance(0, 0))};
}

Result<Refinement> JointRefiner::run() {
  result_.views.assign(now_.poses.size(), {});
  if (equations_.empty()) {
    progress_.advance();
    return result_;
  }
  const auto step_count = static_cast<std::size_t>(options_.max_steps);
  State best = now_;
  std::optional<FittedSurfaces> best_surfaces;
  double former_sigma_mm = 0.0;
  double cell_mm = 0.0;
  double rest = 1.0;
  for (std::size_t i = 0; i <= step_count; ++i, rest *= 1.0 - kStepShare) {
    const Progress of_step = progress_.part(kStepShare * rest);
    auto step = equations_.fit_surfaces(now_.poses, of_step.part(kSurfaceShare));
    if (!step) return stop_at(std::move(best));
    const bool comparable = step->cell_mm == cell_mm;
    const double limit =
        std::abs(readout_change_s_) < kSettledReadout_s ? kMaxWorsening : kMaxUnsettledWorsening;
    if (comparable && step->robust_sigma_mm > limit * former_sigma_mm) {
      go_to(best);
      break;
    }
    cell_mm = step->cell_mm;
    best = now_;
    best_surfaces = *std::move(step);
    const double sigma_mm = best_surfaces->robust_sigma_mm;
    result_.robust_sigma_mm.push_back(sigma_mm);
    const double change_mm = std::abs(sigma_mm - former_sigma_mm);
    const bool converged = comparable && change_mm < options_.convergence_share * sigma_mm &&
                           std::abs(readout_change_s_) < kSettledReadout_s;
    former_sigma_mm = sigma_mm;
    result_.outcome = converged ? RefineOutcome::kConverged : RefineOutcome::kStepLimit;
    if (converged || i == step_count) break;
    if (!move(*best_surfaces, of_step.part(1.0 - kSurfaceShare))) return stop_at(std::move(best));
    result_.steps = static_cast<int>(i) + 1;
  }
  if (best_surfaces) rate_views(*best_surfaces);
  progress_.advance(rest * (1.0 - kStepShare * kSurfaceShare));
  fix_world();
  return result_;
}

}  // namespace

Result<void> JointRefineOptions::validate() const {
  return OptionCheck("JointRefineOptions")
      .not_negative("cell_mm", cell_mm)
      .positive("step_share", step_share)
      .at_least("max_steps", max_steps, 1)
      .positive("convergence_share", convergence_share)
      .positive("tukey_sigmas", tukey_sigmas)
      .positive_up_to("min_inlier_share", min_inlier_share, 1.0)
      .result();
}

std::string_view to_string(RefineOutcome outcome) {
  switch (outcome) {
    case RefineOutcome::kConverged:
      return "converged";
    case RefineOutcome::kStepLimit:
      return "step limit reached";
    case RefineOutcome::kNoOverlap:
      return "no overlap";
  }
  return "";
}

Result<Refinement> refine_jointly(std::vector<AlignedView>& views,
                                  const JointRefineOptions& options, const Workers& workers,
                                  const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (views.empty()) return fail(ErrorCode::kInsufficient, "there is no view to optimize");
  return JointRefiner(views, options, workers, progress).run();
}

Result<Refinement> refine_with_projectors(std::vector<AlignedView>& views,
                                          std::vector<ProjectorMotion>& motions,
                                          const Vec3& p_camera_mm,
                                          const JointRefineOptions& options, const Workers& workers,
                                          const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (views.empty()) return fail(ErrorCode::kInsufficient, "there is no view to optimize");
  JointRefiner refiner(views, options, workers, progress);
  refiner.find_motions(motions, p_camera_mm);
  Result<Refinement> refined = refiner.run();
  if (!refined) return refined;
  for (std::size_t k = 0; k < motions.size(); ++k) motions[k].motion = refiner.motions()[k];
  for (AlignedView& view : views) {
    for (const ProjectorMotion& m : motions) {
      if (!m.concerns(*view.view)) continue;
      view.view = moved_view(*view.view, m.motion, p_camera_mm);
      break;
    }
  }
  return refined;
}

Result<Readout> estimate_readout(std::span<const AlignedView> views,
                                 const trajectory::RowShare& row_share,
                                 const JointRefineOptions& options, const Workers& workers,
                                 const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (views.empty()) return fail(ErrorCode::kInsufficient, "there is no view to optimize");
  const std::size_t count = std::min(views.size(), kMostReadoutViews);
  const auto some = views.subspan((views.size() - count) / 2, count);
  std::vector<AlignedView> unchanged(some.begin(), some.end());
  JointRefiner refiner(unchanged, options, workers, progress);
  refiner.find_readout(row_share, 0.0);
  return refiner.estimate();
}

Result<Refinement> refine_with_readout(std::vector<AlignedView>& views, Readout& readout,
                                       const trajectory::RowShare& row_share,
                                       const JointRefineOptions& options, const Workers& workers,
                                       const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (views.empty()) return fail(ErrorCode::kInsufficient, "there is no view to optimize");
  JointRefiner refiner(views, options, workers, progress);
  refiner.find_readout(row_share, readout.readout_s);
  Result<Refinement> refined = refiner.run();
  if (!refined) return refined;
  readout = refiner.readout();
  views = without_rolling_shutter(std::move(views), readout.readout_s, row_share);
  return refined;
}

}  // namespace flytri::refinement
