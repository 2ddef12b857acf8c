#include "core/refinement/reduced_system.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace flytri::refinement {
namespace {

/// Groups of successive views at the second level: enough to follow a bent path, few enough for a
/// direct solution.
constexpr std::size_t kMaxGroups = 60;
constexpr int kMaxIterations = 400;
/// Relative to the norm of the first residual; far below the change in one step of the outer
/// iteration.
constexpr double kTolerance = 1e-5;
/// Parts of the cells whose products with x are summed by themselves. Their number is fixed, so
/// that the sums do not depend on the number of threads.
constexpr std::size_t kParts = 32;

Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

ReducedSystem::ReducedSystem(std::vector<Vec3> centers_mm)
    : centers_mm_(std::move(centers_mm)),
      information_(centers_mm_.size(), Matrix6::Zero()),
      coupled_(centers_mm_.size(), Matrix6::Zero()),
      gradient_(Eigen::VectorXd::Zero(first_entry_of(centers_mm_.size()))) {
  group_size_ = std::max<std::size_t>(1, (centers_mm_.size() + kMaxGroups - 1) / kMaxGroups);
  group_count_ = (centers_mm_.size() + group_size_ - 1) / group_size_;
}

void ReducedSystem::add_block(const CellViewBlock& block) {
  coupled_[block.view].noalias() += block.coupling * block.coupling.transpose();
  blocks_.push_back(block);
}

void ReducedSystem::add_view(std::size_t view, const Matrix6& information, const Twist& gradient) {
  information_[view] += information;
  gradient_.segment<6>(first_entry_of(view)) += gradient;
}

void ReducedSystem::finish(const Workers& workers, double damping) {
  finish_views(workers, damping);
  finish_groups();
  divide_into_parts();
}

/// Into parts with about the same number of blocks.
void ReducedSystem::divide_into_parts() {
  part_starts_.clear();
  for (std::size_t part = 0; part <= kParts; ++part) {
    const auto first = std::lower_bound(cell_starts_.begin(), cell_starts_.end() - 1,
                                        part * blocks_.size() / kParts);
    part_starts_.push_back(static_cast<std::size_t>(first - cell_starts_.begin()));
  }
}

void ReducedSystem::finish_views(const Workers& workers, double damping) {
  view_inverse_.resize(centers_mm_.size());
  workers.for_each(centers_mm_.size(), [&](std::size_t v) {
    Matrix6& D = information_[v];
    D.diagonal() += damping * D.diagonal();
    // A view that is in no cell does not move.
    if (D.trace() <= 0.0) D = Matrix6::Identity();
    Matrix6 own = D - coupled_[v];
    own.diagonal() += damping * D.diagonal();
    view_inverse_[v] = inverse_of_symmetric(own);
  });
}

Matrix6 ReducedSystem::lift(std::size_t view) const {
  // A group's twist rotates about the first view's center, a view's twist about its own center.
  Matrix6 P = Matrix6::Identity();
  P.block<3, 3>(3, 0) = -cross_matrix(centers_mm_[view] - centers_mm_.front());
  return P;
}

void ReducedSystem::finish_groups() {
  const auto size = first_entry_of(group_count_);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t v = 0; v < centers_mm_.size(); ++v) {
    const auto at = first_entry_of(group_of(v));
    const Matrix6 P = lift(v);
    H.block<6, 6>(at, at) += P.transpose() * information_[v] * P;
  }
  std::vector<std::pair<Eigen::Index, Matrix6>> lifted;
  for (std::size_t cell = 0; cell + 1 < cell_starts_.size(); ++cell) {
    lifted.clear();
    for (std::size_t b = cell_starts_[cell]; b < cell_starts_[cell + 1]; ++b) {
      const auto at = first_entry_of(group_of(blocks_[b].view));
      const Matrix6 M = lift(blocks_[b].view).transpose() * blocks_[b].coupling;
      if (lifted.empty() || lifted.back().first != at) lifted.emplace_back(at, Matrix6::Zero());
      lifted.back().second += M;
    }
    for (const auto& [i, M_i] : lifted) {
      for (const auto& [j, M_j] : lifted) {
        H.block<6, 6>(i, j).noalias() -= M_i * M_j.transpose();
      }
    }
  }
  // The whole scan may move freely, so the matrix is singular; a small damping makes it regular.
  H.diagonal() *= 1.0 + 1e-9;
  group_solver_.compute(H);
}

Eigen::VectorXd ReducedSystem::apply(const Eigen::VectorXd& x, const Workers& workers) const {
  // Reading the blocks takes most of the time, so each cell is read once.
  Eigen::MatrixXd of_parts(x.size(), static_cast<Eigen::Index>(kParts));
  workers.for_each(kParts, [&](std::size_t part) {
    auto y = of_parts.col(static_cast<Eigen::Index>(part));
    y.setZero();
    for (std::size_t cell = part_starts_[part]; cell < part_starts_[part + 1]; ++cell) {
      const std::span blocks(blocks_.data() + cell_starts_[cell],
                             blocks_.data() + cell_starts_[cell + 1]);
      Twist sum = Twist::Zero();
      for (const CellViewBlock& block : blocks)
        sum.noalias() += block.coupling.transpose() * x.segment<6>(first_entry_of(block.view));
      for (const CellViewBlock& block : blocks)
        y.segment<6>(first_entry_of(block.view)).noalias() -= block.coupling * sum;
    }
  });
  Eigen::VectorXd y = of_parts.rowwise().sum();
  for (std::size_t v = 0; v < centers_mm_.size(); ++v)
    y.segment<6>(first_entry_of(v)).noalias() += information_[v] * x.segment<6>(first_entry_of(v));
  return y;
}

Eigen::VectorXd ReducedSystem::precondition(const Eigen::VectorXd& r) const {
  Eigen::VectorXd coarse = Eigen::VectorXd::Zero(first_entry_of(group_count_));
  for (std::size_t v = 0; v < centers_mm_.size(); ++v) {
    coarse.segment<6>(first_entry_of(group_of(v))) +=
        lift(v).transpose() * r.segment<6>(first_entry_of(v));
  }
  coarse = group_solver_.solve(coarse).eval();
  Eigen::VectorXd z(r.size());
  for (std::size_t v = 0; v < centers_mm_.size(); ++v) {
    const auto at = first_entry_of(v);
    z.segment<6>(at) = view_inverse_[v] * r.segment<6>(at) +
                       lift(v) * coarse.segment<6>(first_entry_of(group_of(v)));
  }
  return z;
}

Result<Eigen::VectorXd> ReducedSystem::solve_for(const Eigen::VectorXd& b, const Workers& workers,
                                                 const Progress& progress) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  Eigen::VectorXd r = b;
  const double start = r.norm();
  double done = 0.0;
  Eigen::VectorXd z = precondition(r);
  Eigen::VectorXd p = z;
  double rz = r.dot(z);
  for (int iteration = 0; iteration < kMaxIterations && r.norm() > kTolerance * start;
       ++iteration) {
    if (progress.cancelled()) return stopped();
    const Eigen::VectorXd Hp = apply(p, workers);
    const double curvature = p.dot(Hp);
    // Rounding can make the curvature slightly negative for free motions of the whole scan; then
    // the solution is complete.
    if (curvature <= 0.0) break;
    const double alpha = rz / curvature;
    x += alpha * p;
    r -= alpha * Hp;
    z = precondition(r);
    const double rz_next = r.dot(z);
    p = z + (rz_next / rz) * p;
    rz = rz_next;
    // The residual may rise in between; the progress must not go back.
    const double share = std::log(r.norm() / start) / std::log(kTolerance);
    const double more = std::min(std::max(done, share), 1.0) - done;
    progress.advance(more);
    done += more;
  }
  progress.advance(1.0 - done);
  return x;
}

}  // namespace flytri::refinement
