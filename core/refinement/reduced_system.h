/// @file  The normal equations of all poses after the surfaces are eliminated, and their solution.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/decompositions.h"
#include "core/geometry/rigid.h"

namespace flytri::refinement {

/// The first of the six entries of a view, or of a group of views, in a vector.
[[nodiscard]] inline Eigen::Index first_entry_of(std::size_t index) {
  return 6 * static_cast<Eigen::Index>(index);
}

/// Contribution of one cell to one of its views. J is the Jacobian of the residuals with respect to
/// the view's twist, A with respect to the surface's six parameters, W the weights, and L L^T = A^T
/// W A.
struct CellViewBlock {
  std::uint32_t view = 0;
  Matrix6 coupling;  ///< M = J^T W A L^-T; the cell subtracts M M^T from the views' information
};

/// H x = -g with H = D - sum over cells of M M^T, The matrix H is never computed: it is dense where
/// many views overlap, but H x needs only the blocks.
class ReducedSystem {
 public:
  /// @param centers_mm  center of each view's points, world frame; its twist rotates about it
  explicit ReducedSystem(std::vector<Vec3> centers_mm);

  /// Reserves memory for the blocks, which need most of the memory.
  void reserve(std::size_t block_count) { blocks_.reserve(block_count); }
  /// Adds a block to the present cell; by rising view.
  void add_block(const CellViewBlock& block);
  /// The next blocks belong to another cell.
  void end_cell() { cell_starts_.push_back(blocks_.size()); }
  /// Adds to a view's own information J^T W J and to its gradient.
  void add_view(std::size_t view, const Matrix6& information, const Twist& gradient);
  /// Share of a view's own information that is added as damping, for directions that the other
  /// views do not determine.
  static constexpr double kDamping = 1e-7;
  /// Call once after everything is added.
  void finish(const Workers& workers, double damping = kDamping);

  /// g, six entries per view.
  [[nodiscard]] const Eigen::VectorXd& gradient() const { return gradient_; }

  /// H x, x and the result have six entries per view.
  [[nodiscard]] Eigen::VectorXd apply(const Eigen::VectorXd& x, const Workers& workers) const;

  /// The twists x of H x = -g.
  [[nodiscard]] Result<Eigen::VectorXd> solve(const Workers& workers,
                                              const Progress& progress = {}) const {
    return solve_for(-gradient_, workers, progress);
  }
  /// Solves H x = b by conjugate gradients. The preconditioner has two levels: each view
  /// separately, and groups of successive views as rigid bodies. The second level corrects slow
  /// drift along the path.
  /// @param progress  advanced by one step, as the logarithm of the residual falls
  /// @source  two-level additive Schwarz; Saad, "Iterative Methods for Sparse Linear Systems".
  /// @errors  kCancelled.
  [[nodiscard]] Result<Eigen::VectorXd> solve_for(const Eigen::VectorXd& b, const Workers& workers,
                                                  const Progress& progress = {}) const;

 private:
  [[nodiscard]] std::size_t group_of(std::size_t view) const { return view / group_size_; }
  [[nodiscard]] Matrix6 lift(std::size_t view) const;
  [[nodiscard]] Eigen::VectorXd precondition(const Eigen::VectorXd& r) const;
  void finish_views(const Workers& workers, double damping);
  void finish_groups();
  void divide_into_parts();

  std::vector<Vec3> centers_mm_;
  std::vector<Matrix6> information_;  ///< D, by view
  std::vector<Matrix6> coupled_;      ///< sum of M M^T, by view
  Eigen::VectorXd gradient_;
  std::vector<CellViewBlock> blocks_;           ///< cell after cell
  std::vector<std::size_t> cell_starts_ = {0};  ///< in blocks_
  std::vector<std::size_t> part_starts_;        ///< parts of the cells, for H x
  std::vector<Matrix6> view_inverse_;
  std::size_t group_size_ = 1;
  std::size_t group_count_ = 1;
  Eigen::LDLT<Eigen::MatrixXd> group_solver_;
};

}  // namespace flytri::refinement
