#include "core/refinement/projector_system.h"

namespace flytri::refinement {
namespace {

/// First entry of a view or projector.
Eigen::Index first_of(std::size_t index) { return 6 * static_cast<Eigen::Index>(index); }

}  // namespace

ProjectorSystem::ProjectorSystem(ReducedSystem& poses, std::size_t view_count,
                                 std::size_t projector_count)
    : poses_(poses),
      projector_count_(projector_count),
      with_views_(Eigen::MatrixXd::Zero(first_of(view_count), first_of(projector_count))),
      information_(Eigen::MatrixXd::Zero(first_of(projector_count), first_of(projector_count))),
      gradient_(Eigen::VectorXd::Zero(first_of(projector_count))) {}

void ProjectorSystem::add_cell(std::span<const CellViewShare> shares) {
  add_to(poses_, shares);
  std::vector<Matrix6> couplings(projector_count_, Matrix6::Zero());
  std::vector<bool> used(projector_count_, false);
  for (const CellViewShare& share : shares) {
    if (!share.projector) continue;
    const CellProjectorShare& of_projector = *share.projector;
    const Eigen::Index at = first_of(of_projector.projector);
    information_.block<6, 6>(at, at) += of_projector.information;
    gradient_.segment<6>(at) += of_projector.gradient;
    with_views_.block<6, 6>(first_of(share.block.view), at) += of_projector.with_view;
    couplings[of_projector.projector] += of_projector.coupling;
    used[of_projector.projector] = true;
  }
  for (std::size_t k = 0; k < projector_count_; ++k) {
    if (!used[k]) continue;
    const Matrix6 transposed = couplings[k].transpose();
    for (const CellViewShare& share : shares) {
      with_views_.block<6, 6>(first_of(share.block.view), first_of(k)).noalias() -=
          share.block.coupling * transposed;
    }
    for (std::size_t l = 0; l < projector_count_; ++l) {
      if (!used[l]) continue;
      information_.block<6, 6>(first_of(l), first_of(k)).noalias() -= couplings[l] * transposed;
    }
  }
}

void ProjectorSystem::add_prior(std::size_t projector, const Matrix6& information,
                                const Twist& motion) {
  const Eigen::Index at = first_of(projector);
  information_.block<6, 6>(at, at) += information;
  gradient_.segment<6>(at) += information * motion;
}

Result<ProjectorStep> ProjectorSystem::solve(const Workers& workers,
                                             const Progress& progress) const {
  const Eigen::Index count = gradient_.size();
  const Progress of_one = progress.part(1.0 / static_cast<double>(count + 1));
  auto views = poses_.solve(workers, of_one);
  if (!views) return tl::unexpected(views.error());
  // How the poses follow each unknown of the projectors.
  Eigen::MatrixXd following(with_views_.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto column = poses_.solve_for(with_views_.col(k), workers, of_one);
    if (!column) return tl::unexpected(column.error());
    following.col(k) = *column;
  }
  // What the poses leave to the projectors (Schur complement).
  const Eigen::MatrixXd left = information_ - with_views_.transpose() * following;
  const Eigen::VectorXd right = -gradient_ - with_views_.transpose() * *views;
  const Eigen::VectorXd projectors = Eigen::LDLT<Eigen::MatrixXd>(left).solve(right);
  return ProjectorStep{*views - following * projectors, projectors};
}

}  // namespace flytri::refinement
