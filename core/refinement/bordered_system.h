/// @file  The normal equations of the poses, and of a few more unknowns that many views share.
#pragma once

#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/refinement/joint_equations.h"
#include "core/refinement/reduced_system.h"

namespace flytri::refinement {

/// The solution of one step.
struct BorderedStep {
  Eigen::VectorXd views;   ///< six entries per view
  Eigen::VectorXd shared;  ///< SharedUnknowns::size entries per group
  /// Covariance of these, if the residuals have unit variance and are independent.
  Eigen::MatrixXd shared_covariance;
};

/// The equations of the poses, bordered by those of the shared unknowns.
class BorderedSystem {
 public:
  /// @param poses  the equations of the poses alone; must outlive this
  BorderedSystem(ReducedSystem& poses, std::size_t view_count, std::size_t group_count,
                 std::size_t group_size);

  /// Adds a cell to both.
  void add_cell(std::span<const CellViewShare> shares);
  /// Holds a group near zero.
  /// @param value  of its unknowns so far
  void add_prior(std::size_t group, const Eigen::MatrixXd& information,
                 const Eigen::VectorXd& value);

  /// After ReducedSystem::finish().
  /// @errors  kCancelled.
  [[nodiscard]] Result<BorderedStep> solve(const Workers& workers, const Progress& progress) const;

 private:
  /// First entry of a group.
  [[nodiscard]] Eigen::Index first_of(std::size_t group) const {
    return static_cast<Eigen::Index>(group) * size_;
  }

  ReducedSystem& poses_;
  std::size_t group_count_;
  Eigen::Index size_;            ///< of a group
  Eigen::MatrixXd with_views_;   ///< rows: views, columns: shared unknowns
  Eigen::MatrixXd information_;  ///< of the shared unknowns
  Eigen::VectorXd gradient_;     ///< of the shared unknowns
};

}  // namespace flytri::refinement
