/// @file  The normal equations of the poses, with the motions of a few projectors beside them.
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
struct ProjectorStep {
  Eigen::VectorXd views;       ///< six entries per view
  Eigen::VectorXd projectors;  ///< six entries per projector
};

/// The equations of the poses, with six more unknowns for each projector. Many views share these.
class ProjectorSystem {
 public:
  /// @param poses  the equations of the poses alone; must outlive this
  ProjectorSystem(ReducedSystem& poses, std::size_t view_count, std::size_t projector_count);

  /// Adds a cell to both.
  void add_cell(std::span<const CellViewShare> shares);
  /// Holds a projector near where it was calibrated.
  /// @param motion  by how much it has moved so far
  void add_prior(std::size_t projector, const Matrix6& information, const Twist& motion);

  /// After ReducedSystem::finish().
  /// @errors  kCancelled.
  [[nodiscard]] Result<ProjectorStep> solve(const Workers& workers, const Progress& progress) const;

 private:
  ReducedSystem& poses_;
  std::size_t projector_count_;
  Eigen::MatrixXd with_views_;   ///< rows: views, columns: projectors
  Eigen::MatrixXd information_;  ///< of the projectors
  Eigen::VectorXd gradient_;     ///< of the projectors
};

}  // namespace flytri::refinement
