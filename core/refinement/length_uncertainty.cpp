#include "core/refinement/length_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/check_options.h"
#include "core/geometry/cell_key.h"
#include "core/geometry/decompositions.h"
#include "core/refinement/joint_equations.h"

namespace flytri::refinement {
namespace {

/// Far below that of the refinement: a damped scan would look stiffer than it is.
constexpr double kLowDamping = 1e-10;
/// Below this, the data around a place leave a direction or a turn open.
constexpr double kMinPivotShare = 1e-6;
/// Shares of time.
constexpr double kFitShare = 0.3, kEquationShare = 0.3;

/// What one cell says against the solution, for one view.
struct ViewGradient {
  std::uint32_t view;
  Twist gradient;
};

/// Gradients of the cells in one cube of space.
struct Cluster {
  std::vector<ViewGradient> gradients;
};

class LengthJudge {
 public:
  LengthJudge(std::span<const AlignedView> views, const LengthUncertaintyOptions& options,
              const Workers& workers)
      : options_(options), workers_(workers), equations_(views, options.refinement, workers) {
    for (const AlignedView& view : views) poses_.push_back(view.T_world_sensor);
  }

  Result<std::vector<std::optional<double>>> judge(std::span<const Span> spans,
                                                   const Progress& progress);

 private:
  /// Adds how the place moves along `direction` with the twist of each view. False if the data
  /// there do not tell.
  [[nodiscard]] bool add_motion(const FittedSurfaces& surfaces, const Vec3& p_mm,
                                const Vec3& direction, Eigen::VectorXd& motion) const;
  [[nodiscard]] Result<std::optional<double>> judge(const Span& span,
                                                    const FittedSurfaces& surfaces,
                                                    const ReducedSystem& system,
                                                    const Progress& progress) const;
  [[nodiscard]] double scatter_of(const Eigen::VectorXd& influence) const;
  void find_inflation(const FittedSurfaces& surfaces);

  const LengthUncertaintyOptions& options_;
  const Workers& workers_;
  std::vector<Isometry> poses_;
  JointEquations equations_;
  std::vector<Vec3> centers_mm_;
  std::vector<Cluster> clusters_;
  double inflation_ = 1.0;
};

/// Residuals are smaller than the errors, above all where there are few data. Data of one profile
/// in one cell share their noise: they count as fewer.
void LengthJudge::find_inflation(const FittedSurfaces& surfaces) {
  double count = 0.0, squares = 0.0, squares_of_sums = 0.0;
  double parameters = 6.0 * static_cast<double>(poses_.size());
  for (std::size_t c = 0; c < surfaces.cells.size(); ++c) {
    const std::vector<ResidualSize>& residuals = surfaces.residuals[c];
    if (residuals.empty()) continue;
    parameters += 6.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      if (residuals[k].usable) {
        const double r = residuals[k].residual_mm / residuals[k].sigma_mm;
        count += 1.0;
        squares += r * r;
        sum += r;
      }
      const auto view_of = [&](std::size_t i) {
        return equations_.data()[surfaces.cells[c].data[i]].view;
      };
      if (k + 1 < residuals.size() && view_of(k) == view_of(k + 1)) continue;
      squares_of_sums += sum * sum;
      sum = 0.0;
    }
  }
  const double independent = squares_of_sums > squares ? count * squares / squares_of_sums : count;
  inflation_ = equations_.step_factor(surfaces) *
               std::sqrt(independent / std::max(independent - parameters, 0.1 * independent));
}

/// The place moves as the mean of its views. A view counts in a direction as much as its data fix
/// it.
bool LengthJudge::add_motion(const FittedSurfaces& surfaces, const Vec3& p_mm,
                             const Vec3& direction, Eigen::VectorXd& motion) const {
  const auto by_view = equations_.information_near(surfaces, poses_, p_mm, options_.place_mm);
  Matrix6 sum = Matrix6::Zero();
  for (const auto& [view, information] : by_view) sum += information;
  Twist along;
  along << Vec3::Zero(), direction;
  const auto share = solve_symmetric(sum, along, kMinPivotShare);
  if (by_view.empty() || !share) return false;
  for (const auto& [view, information] : by_view) {
    const Twist pull = information * *share;
    Twist of_view = pull;
    of_view.head<3>() += (p_mm - centers_mm_[view]).cross(pull.tail<3>());
    motion.segment<6>(first_entry_of(view)) += of_view;
  }
  return true;
}

double LengthJudge::scatter_of(const Eigen::VectorXd& influence) const {
  double sum = 0.0;
  for (const Cluster& cluster : clusters_) {
    double of_cluster = 0.0;
    for (const ViewGradient& part : cluster.gradients) {
      of_cluster += part.gradient.dot(influence.segment<6>(first_entry_of(part.view)));
    }
    sum += of_cluster * of_cluster;
  }
  return std::sqrt(sum);
}

Result<std::optional<double>> LengthJudge::judge(const Span& span, const FittedSurfaces& surfaces,
                                                 const ReducedSystem& system,
                                                 const Progress& progress) const {
  const Vec3 direction = (span.to_mm - span.from_mm).normalized();
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(first_entry_of(poses_.size()));
  if (!add_motion(surfaces, span.to_mm, direction, motion) ||
      !add_motion(surfaces, span.from_mm, -direction, motion)) {
    progress.advance();
    return std::nullopt;
  }
  const auto influence = system.solve_for(motion, workers_, progress);
  if (!influence) return tl::unexpected(influence.error());
  // Parts that nothing connects move freely against each other.
  const double sigma_mm = inflation_ * scatter_of(*influence);
  if (!(sigma_mm < options_.place_mm)) return std::nullopt;
  return sigma_mm;
}

Result<std::vector<std::optional<double>>> LengthJudge::judge(std::span<const Span> spans,
                                                              const Progress& progress) {
  std::vector<std::optional<double>> sigmas(spans.size());
  if (spans.empty() || equations_.empty()) {
    progress.advance();
    return sigmas;
  }
  centers_mm_ = equations_.view_centers_mm(poses_);
  const auto surfaces = equations_.fit_surfaces(poses_, progress.part(kFitShare));
  if (!surfaces) return tl::unexpected(surfaces.error());
  find_inflation(*surfaces);
  ReducedSystem system(centers_mm_);
  system.reserve(equations_.count_views_of_cells(*surfaces));
  std::map<CellKey, Cluster> clusters;
  const auto take = [&](std::size_t cell, std::span<const CellViewShare> shares) {
    add_to(system, shares);
    Cluster& cluster = clusters[CellKey::at(surfaces->cells[cell].origin_mm, options_.cluster_mm)];
    for (const CellViewShare& share : shares) {
      cluster.gradients.push_back({share.block.view, share.gradient});
    }
  };
  if (!equations_.sum_cells(*surfaces, poses_, centers_mm_, progress.part(kEquationShare), take)) {
    return stopped();
  }
  for (auto& [key, cluster] : clusters) clusters_.push_back(std::move(cluster));
  system.finish(workers_, kLowDamping);
  const Progress of_spans =
      progress.part((1.0 - kFitShare - kEquationShare) / static_cast<double>(spans.size()));
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const auto sigma = judge(spans[i], *surfaces, system, of_spans);
    if (!sigma) return tl::unexpected(sigma.error());
    sigmas[i] = *sigma;
  }
  return sigmas;
}

}  // namespace

Result<void> LengthUncertaintyOptions::validate() const {
  return refinement.validate().and_then([&] {
    return OptionCheck("LengthUncertaintyOptions")
        .positive("place_mm", place_mm)
        .positive("cluster_mm", cluster_mm)
        .result();
  });
}

Result<std::vector<std::optional<double>>> length_uncertainties(
    std::span<const AlignedView> views, std::span<const Span> spans,
    const LengthUncertaintyOptions& options, const Workers& workers, const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (views.empty()) return fail(ErrorCode::kInsufficient, "there is no view to judge");
  return LengthJudge(views, options, workers).judge(spans, progress);
}

}  // namespace flytri::refinement
