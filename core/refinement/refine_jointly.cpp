#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/geometry/point_spacing.h"
#include "core/refinement/reduced_system.h"
#include "core/refinement/refine.h"
#include "core/refinement/surface_cells.h"

namespace flytri::refinement {
namespace {

/// Default edge of a cell in spacings of neighboring points.
constexpr double kCellSpacings = 16.0;
/// Length of a profile that becomes one datum, as a share of a cell's edge.
constexpr double kDatumShare = 0.2;
/// A step must not raise the robust spread by more than this.
constexpr double kMaxWorsening = 1.02;
/// If a smaller share of the data is in cells with a surface, the cells are enlarged by this
/// factor, up to this many times.
constexpr double kMinValidShare = 0.5;
constexpr double kEnlargement = 1.5;
constexpr int kMaxEnlargements = 3;
/// Shares of time: of a step in the remaining time (the number of steps is unknown); of the
/// surfaces in a step; of the sums in the pose update.
constexpr double kStepShare = 0.25, kSurfaceShare = 0.5, kSumShare = 0.4;

/// The stored part of a residual. The rest is computed again when needed, to save memory.
struct ResidualSize {
  double residual_mm = 0.0;
  double sigma_mm = 0.0;
  bool usable = false;
};

/// Data of one step.
struct Step {
  double cell_mm = 0.0;
  std::vector<SurfaceCell> cells;
  std::vector<std::vector<ResidualSize>> residuals;  ///< by cell, parallel to its data
  double spread = 1.0;           ///< robust standard deviation of the normalized residuals
  double robust_sigma_mm = 0.0;  ///< of the residuals themselves
};

double median_abs(std::vector<double>& values) { return values.empty() ? 0.0 : median_of(values); }

void measure_spread(Step& step) {
  std::vector<double> normalized;
  std::vector<double> plain;
  for (const auto& cell : step.residuals) {
    for (const ResidualSize& r : cell) {
      if (!r.usable) continue;
      normalized.push_back(std::abs(r.residual_mm) / r.sigma_mm);
      plain.push_back(std::abs(r.residual_mm));
    }
  }
  step.spread = std::max(kSigmaOfMedian * median_abs(normalized), 1e-12);
  step.robust_sigma_mm = kSigmaOfMedian * median_abs(plain);
}

Result<Step> fit_surfaces(std::span<const Datum> data, std::span<const Isometry> poses,
                          double cell_mm, const Workers& workers, const Progress& progress) {
  Step step{cell_mm, divide_space(data, poses, cell_mm), {}, 1.0, 0.0};
  step.residuals.resize(step.cells.size());
  const auto fit = [&](std::size_t c) {
    SurfaceCell& cell = step.cells[c];
    fit_surface(cell, data, poses, cell_mm);
    if (!cell.valid) return;
    step.residuals[c].reserve(cell.data.size());
    for (const std::uint32_t i : cell.data) {
      const SurfaceResidual r = residual_of(cell, data[i], poses[data[i].view.at()], cell_mm);
      step.residuals[c].push_back({r.residual_mm, r.sigma_mm, r.usable});
    }
  };
  if (!workers.for_each_unless_cancelled(step.cells.size(), fit, progress)) return stopped();
  measure_spread(step);
  return step;
}

/// Share of the data that lies in cells with a surface.
double valid_share(const Step& step) {
  std::size_t valid = 0;
  std::size_t all = 0;
  for (const SurfaceCell& cell : step.cells) {
    all += cell.data.size();
    if (cell.valid) valid += cell.data.size();
  }
  return all == 0 ? 0.0 : static_cast<double>(valid) / static_cast<double>(all);
}

/// Sums over one cell, by view.
struct CellSums {
  struct ViewSums {
    std::uint32_t view = 0;
    Matrix6 JJ = Matrix6::Zero();
    Matrix6 JA = Matrix6::Zero();
    Twist Jr = Twist::Zero();
  };
  std::vector<ViewSums> views;
  Matrix6 AA = Matrix6::Zero();
  Quadric Ar = Quadric::Zero();
};

/// Eliminates the cell's surface and adds the cell to the system.
void add_cell(const CellSums& sums, ReducedSystem& system) {
  if (sums.views.size() < 2) return;
  const Eigen::LLT<Matrix6> cholesky(sums.AA);
  // The cell has too few inliers to determine its surface, so it is not used.
  if (cholesky.info() != Eigen::Success || cholesky.rcond() < 1e-9) return;
  const Quadric LAr = cholesky.matrixL().solve(sums.Ar);
  std::vector<CellViewBlock> blocks;
  for (const auto& of_view : sums.views) {
    CellViewBlock block;
    block.view = of_view.view;
    block.coupling = cholesky.matrixL().solve(of_view.JA.transpose()).transpose();
    system.add_view(of_view.view, of_view.JJ, of_view.Jr - block.coupling * LAr);
    blocks.push_back(block);
  }
  system.add_cell(blocks);
}

/// Joint optimization of one scan.
class JointRefiner {
 public:
  JointRefiner(std::vector<AlignedView>& views, const JointRefineOptions& options,
               const Workers& workers, const Progress& progress)
      : views_(views), options_(options), workers_(workers), progress_(progress) {
    for (const AlignedView& view : views) poses_.push_back(view.T_world_sensor);
    cell_mm_ =
        options.cell_mm > 0.0 ? options.cell_mm : kCellSpacings * median_point_spacing_mm(views);
    if (cell_mm_ > 0.0) data_ = gather_data(views, kDatumShare * cell_mm_);
    arm_mm_ = mean_radius_mm();
  }

  Result<Refinement> run();

 private:
  [[nodiscard]] std::vector<Vec3> view_centers() const;
  [[nodiscard]] double mean_radius_mm() const;
  [[nodiscard]] Result<Step> fit_surfaces_over_drift(const Progress& progress) const;
  /// Moves all poses by one Gauss-Newton step. False if canceled; then no pose moved.
  [[nodiscard]] bool move(const Step& step, const Progress& progress);
  [[nodiscard]] CellSums sum_cell(const Step& step, std::size_t c,
                                  std::span<const Vec3> centers_mm) const;
  /// Number of pairs of a cell and a view with data in it.
  [[nodiscard]] std::size_t count_views_of_cells(const Step& step) const;
  /// Adds all cells in order. False if canceled.
  [[nodiscard]] bool add_cells(const Step& step, std::span<const Vec3> centers_mm,
                               ReducedSystem& system, const Progress& progress) const;
  void rate_views(const Step& step);
  void fix_world();
  /// Ends a run that was canceled with the best poses found so far.
  [[nodiscard]] tl::unexpected<Error> stop_at(std::vector<Isometry> best);

  std::vector<AlignedView>& views_;
  const JointRefineOptions& options_;
  const Workers& workers_;
  const Progress& progress_;
  std::vector<Isometry> poses_;
  std::vector<Datum> data_;
  double cell_mm_ = 0.0;
  double arm_mm_ = 1.0;  ///< lever arm: a rotation moves the points of a view by this times the
                         ///< angle
  Refinement result_;
};

/// If poses are wrong by much, the data of a small cell do not form a surface; a larger cell may
/// still work.
Result<Step> JointRefiner::fit_surfaces_over_drift(const Progress& progress) const {
  double cell_mm = cell_mm_;
  auto step = fit_surfaces(data_, poses_, cell_mm, workers_, progress);
  for (int i = 0; i < kMaxEnlargements && step && valid_share(*step) < kMinValidShare; ++i) {
    cell_mm *= kEnlargement;
    // The repetition was not planned, so it does not advance the progress.
    step = fit_surfaces(data_, poses_, cell_mm, workers_, progress.part(0.0));
  }
  return step;
}

std::vector<Vec3> JointRefiner::view_centers() const {
  std::vector<Vec3> centers(poses_.size(), Vec3::Zero());
  std::vector<double> counts(poses_.size(), 0.0);
  for (const Datum& datum : data_) {
    centers[datum.view.at()] += datum.position_mm;
    counts[datum.view.at()] += 1.0;
  }
  for (std::size_t v = 0; v < centers.size(); ++v) {
    centers[v] = poses_[v] * Vec3(centers[v] / std::max(counts[v], 1.0));
  }
  return centers;
}

double JointRefiner::mean_radius_mm() const {
  if (data_.empty()) return 1.0;
  double sum = 0.0;
  for (const Datum& datum : data_) sum += datum.position_mm.norm();
  return sum / static_cast<double>(data_.size());
}

bool JointRefiner::move(const Step& step, const Progress& progress) {
  const std::vector<Vec3> centers = view_centers();
  ReducedSystem system(centers);
  const double step_mm = options_.step_share * cell_mm_;
  Twist prior;
  prior << Vec3::Constant(1.0 / (step_mm / arm_mm_)), Vec3::Constant(1.0 / step_mm);
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    system.add_view(v, prior.cwiseAbs2().asDiagonal(), Twist::Zero());
  }
  if (!add_cells(step, centers, system, progress.part(kSumShare))) return false;
  system.finish(workers_);
  if (progress.cancelled()) return false;
  const auto x = system.solve(workers_, progress.part(1.0 - kSumShare));
  if (!x) return false;
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    const Twist twist = x->segment<6>(6 * static_cast<Eigen::Index>(v));
    const Eigen::Translation3d to_center(-centers[v]);
    poses_[v] = to_center.inverse() * exp_twist(twist) * to_center * poses_[v];
  }
  return true;
}

CellSums JointRefiner::sum_cell(const Step& step, std::size_t c,
                                std::span<const Vec3> centers_mm) const {
  const SurfaceCell& cell = step.cells[c];
  CellSums sums;
  for (std::size_t k = 0; k < step.residuals[c].size(); ++k) {
    const ResidualSize& size = step.residuals[c][k];
    if (!size.usable) continue;
    // While the poses are wrong, the residuals are larger than the noise.
    const double sigma_mm = step.spread * size.sigma_mm;
    const double weight =
        tukey_weight(size.residual_mm / sigma_mm, options_.tukey_sigmas) / (sigma_mm * sigma_mm);
    if (weight == 0.0) continue;
    const Datum& datum = data_[cell.data[k]];
    const auto view = static_cast<std::uint32_t>(datum.view.value);
    const SurfaceResidual r = residual_of(cell, datum, poses_[view], step.cell_mm);
    // Data are sorted by view.
    if (sums.views.empty() || sums.views.back().view != view) sums.views.push_back({view});
    auto& of_view = sums.views.back();
    Twist J;
    J << (r.foot_mm - centers_mm[view]).cross(r.gradient), r.gradient;
    of_view.JJ.noalias() += weight * J * J.transpose();
    of_view.JA.noalias() += weight * J * r.terms.transpose();
    of_view.Jr += weight * r.residual_mm * J;
    sums.AA.noalias() += weight * r.terms * r.terms.transpose();
    sums.Ar += weight * r.residual_mm * r.terms;
  }
  return sums;
}

std::size_t JointRefiner::count_views_of_cells(const Step& step) const {
  std::size_t count = 0;
  for (const SurfaceCell& cell : step.cells) {
    if (!cell.valid) continue;
    for (std::size_t k = 0; k < cell.data.size(); ++k) {
      if (k == 0 || data_[cell.data[k]].view != data_[cell.data[k - 1]].view) ++count;
    }
  }
  return count;
}

bool JointRefiner::add_cells(const Step& step, std::span<const Vec3> centers_mm,
                             ReducedSystem& system, const Progress& progress) const {
  // Block by block, so that the sums need little memory.
  constexpr std::size_t kBlock = 1024;
  system.reserve(count_views_of_cells(step));
  std::vector<CellSums> sums(kBlock);
  const std::size_t count = step.cells.size();
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    const Progress of_block = progress.part(static_cast<double>(size) / static_cast<double>(count));
    const auto sum = [&](std::size_t i) { sums[i] = sum_cell(step, begin + i, centers_mm); };
    if (!workers_.for_each_unless_cancelled(size, sum, of_block)) return false;
    for (std::size_t i = 0; i < size; ++i) add_cell(sums[i], system);
  }
  return true;
}

void JointRefiner::rate_views(const Step& step) {
  result_.views.assign(poses_.size(), {});
  std::vector<std::size_t> inliers(poses_.size(), 0);
  const double limit = options_.tukey_sigmas * step.spread;
  for (std::size_t c = 0; c < step.cells.size(); ++c) {
    for (std::size_t k = 0; k < step.residuals[c].size(); ++k) {
      const ResidualSize& r = step.residuals[c][k];
      if (!r.usable) continue;
      const std::size_t v = data_[step.cells[c].data[k]].view.at();
      ++result_.views[v].count;
      if (std::abs(r.residual_mm) >= limit * r.sigma_mm) continue;
      ++inliers[v];
      result_.views[v].rms_mm += r.residual_mm * r.residual_mm;
    }
  }
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    ViewResidual& view = result_.views[v];
    if (view.count == 0) continue;
    view.inlier_share = static_cast<double>(inliers[v]) / static_cast<double>(view.count);
    view.rms_mm = std::sqrt(view.rms_mm / std::max<double>(1.0, static_cast<double>(inliers[v])));
  }
}

void JointRefiner::fix_world() {
  const Isometry T_old_new = views_.front().T_world_sensor * poses_.front().inverse();
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    // Normalize the rotation after many products.
    const Isometry T = T_old_new * poses_[v];
    views_[v].T_world_sensor = make_isometry(Eigen::Quaterniond(T.linear()), T.translation());
  }
  views_.front().T_world_sensor = T_old_new * poses_.front();
}

tl::unexpected<Error> JointRefiner::stop_at(std::vector<Isometry> best) {
  poses_ = std::move(best);
  fix_world();
  return stopped();
}

Result<Refinement> JointRefiner::run() {
  result_.views.assign(poses_.size(), {});
  if (data_.empty()) {
    progress_.advance();
    return result_;
  }
  const auto step_count = static_cast<std::size_t>(options_.max_steps);
  std::vector<Isometry> best = poses_;
  double former_sigma_mm = 0.0;
  double cell_mm = 0.0;
  double rest = 1.0;
  for (std::size_t i = 0; i <= step_count; ++i, rest *= 1.0 - kStepShare) {
    const Progress of_step = progress_.part(kStepShare * rest);
    const auto step = fit_surfaces_over_drift(of_step.part(kSurfaceShare));
    if (!step) return stop_at(std::move(best));
    const bool comparable = step->cell_mm == cell_mm;
    if (comparable && step->robust_sigma_mm > kMaxWorsening * former_sigma_mm) {
      poses_ = best;
      break;
    }
    cell_mm = step->cell_mm;
    best = poses_;
    result_.robust_sigma_mm.push_back(step->robust_sigma_mm);
    rate_views(*step);
    const double change_mm = std::abs(step->robust_sigma_mm - former_sigma_mm);
    const bool converged =
        comparable && change_mm < options_.convergence_share * step->robust_sigma_mm;
    former_sigma_mm = step->robust_sigma_mm;
    result_.outcome = converged ? RefineOutcome::kConverged : RefineOutcome::kStepLimit;
    if (converged || i == step_count) break;
    if (!move(*step, of_step.part(1.0 - kSurfaceShare))) return stop_at(std::move(best));
    result_.steps = static_cast<int>(i) + 1;
  }
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

}  // namespace flytri::refinement
