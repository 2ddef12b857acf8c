#include "core/refinement/bordered_system.h"

namespace flytri::refinement {
BorderedSystem::BorderedSystem(ReducedSystem& poses, std::size_t view_count,
                               std::size_t group_count, std::size_t group_size)
    : poses_(poses), group_count_(group_count), size_(static_cast<Eigen::Index>(group_size)) {
  const Eigen::Index count = first_of(group_count);
  with_views_ = Eigen::MatrixXd::Zero(first_entry_of(view_count), count);
  information_ = Eigen::MatrixXd::Zero(count, count);
  gradient_ = Eigen::VectorXd::Zero(count);
}

void BorderedSystem::add_cell(std::span<const CellViewShare> shares) {
  add_to(poses_, shares);
  std::vector<SharedMatrix> couplings(group_count_, SharedMatrix::Zero(size_, 6));
  std::vector<bool> used(group_count_, false);
  for (const CellViewShare& share : shares) {
    if (!share.shared) continue;
    const CellSharedShare& shared = *share.shared;
    const Eigen::Index at = first_of(shared.group);
    information_.block(at, at, size_, size_) += shared.information;
    gradient_.segment(at, size_) += shared.gradient;
    with_views_.block(first_entry_of(share.block.view), at, 6, size_) += shared.with_view;
    couplings[shared.group] += shared.coupling;
    used[shared.group] = true;
  }
  for (std::size_t k = 0; k < group_count_; ++k) {
    if (!used[k]) continue;
    const SharedMatrix transposed = couplings[k].transpose();
    for (const CellViewShare& share : shares) {
      with_views_.block(first_entry_of(share.block.view), first_of(k), 6, size_).noalias() -=
          share.block.coupling * transposed;
    }
    for (std::size_t l = 0; l < group_count_; ++l) {
      if (!used[l]) continue;
      information_.block(first_of(l), first_of(k), size_, size_).noalias() -=
          couplings[l] * transposed;
    }
  }
}

void BorderedSystem::add_prior(std::size_t group, const Eigen::MatrixXd& information,
                               const Eigen::VectorXd& value) {
  const Eigen::Index at = first_of(group);
  information_.block(at, at, size_, size_) += information;
  gradient_.segment(at, size_) += information * value;
}

Result<BorderedStep> BorderedSystem::solve(const Workers& workers, const Progress& progress) const {
  const Eigen::Index count = gradient_.size();
  const Progress of_one = progress.part(1.0 / static_cast<double>(count + 1));
  auto views = poses_.solve(workers, of_one);
  if (!views) return tl::unexpected(views.error());
  // How the poses follow each of the shared unknowns.
  Eigen::MatrixXd following(with_views_.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto column = poses_.solve_for(with_views_.col(k), workers, of_one);
    if (!column) return tl::unexpected(column.error());
    following.col(k) = *column;
  }
  // What the poses leave to the shared unknowns (Schur complement).
  const Eigen::MatrixXd left = information_ - with_views_.transpose() * following;
  const Eigen::VectorXd right = -gradient_ - with_views_.transpose() * *views;
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(left);
  const Eigen::VectorXd shared = ldlt.solve(right);
  return BorderedStep{*views - following * shared, shared,
                      ldlt.solve(Eigen::MatrixXd::Identity(count, count))};
}

}  // namespace flytri::refinement
