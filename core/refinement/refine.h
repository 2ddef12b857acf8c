/// @file  Global optimization: all views of a scan are aligned together.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/view.h"
#include "core/registration/align.h"

namespace flytri::refinement {

struct JointRefineOptions {
  /// >= 0. Edge of the cells in which the surface is described by one quadric, mm. 0: 16 times the
  /// spacing of neighboring points: large enough for lines of several views, small against a cusp.
  double cell_mm = 0.0;
  /// >= 1. Most Gauss-Newton steps.
  int max_steps = 15;
  /// > 0. A step is expected to move a view by no more than this share of a cell: directions that
  /// the surface hardly determines do not run away. It costs nothing where a step ends at zero.
  double step_share = 0.25;
  /// > 0. Converged when a step changes the robust spread of the residuals by less than this share.
  /// The spread itself trembles by about as much as data change cells.
  double convergence_share = 0.003;
  /// > 0. Residuals above this many robust standard deviations count for nothing.
  double tukey_sigmas = 4.0;
  /// (0, 1]. A view with a smaller share of residuals that count contradicts the others.
  double min_inlier_share = 0.5;

  [[nodiscard]] Result<void> validate() const;
};

enum class RefineOutcome {
  kConverged,
  kStepLimit,  ///< still moving after the last step; the poses are the best found
  kNoOverlap   ///< no cell is seen by two views; the poses are as they were
};
[[nodiscard]] std::string_view to_string(RefineOutcome outcome);

/// How one view met the common surface.
struct ViewResidual {
  std::size_t count = 0;      ///< data that fell into cells seen by other views too
  double inlier_share = 0.0;  ///< of these, those that count
  double rms_mm = 0.0;        ///< of those that count, along the surface normal
};

struct Refinement {
  RefineOutcome outcome = RefineOutcome::kNoOverlap;
  int steps = 0;
  std::vector<double> robust_sigma_mm;  ///< of all residuals, before each step and after the last
  std::vector<ViewResidual> views;      ///< parallel to the views
  /// True where a view contradicts the others (JointRefineOptions::min_inlier_share).
  [[nodiscard]] bool contradicts(std::size_t view, const JointRefineOptions& options) const {
    return views[view].count > 0 && views[view].inlier_share < options.min_inlier_share;
  }
};

/// Optimizes all poses together over all overlaps, V-H, V-V and H-H: in every cell of space the
/// surface is a quadric whose six parameters are eliminated, and each measured point has a residual
/// along its own measurement ray. The world frame stays the sensor frame of the first view.
///
/// The Jacobian is taken at the foot point on the quadric: taken at the noisy point it would bias
/// the solution. A quadric follows each rigid motion of its cell, so moving the whole scan costs
/// nothing.
///
/// @param views     by time, at least one; changed are only the poses.
/// @param progress  advanced by one step
/// @source  own; it takes the place of Arold et al., "Global Optimization", see
///          docs/adr/0004-joint-refinement.md.
/// @errors  kBadOption, kInsufficient: no view, kCancelled (poses as they were).
[[nodiscard]] Result<Refinement> refine_jointly(std::vector<AlignedView>& views,
                                                const JointRefineOptions& options,
                                                const Workers& workers,
                                                const Progress& progress = {});

struct MetaviewRefineOptions {
  /// Of one view to its metaview. Guesses are near: the search begins narrow.
  registration::AlignOptions align;
  /// >= 1. Most rounds in which every view is registered once.
  int max_rounds = 20;
  /// > 0. Ends when a round moves the views by less than this share of a view's radius, RMS.
  double convergence_share = 2e-5;
  /// Seed of the order of the views.
  std::uint64_t seed = 1;

  [[nodiscard]] Result<void> validate() const;
};

struct MetaviewRefinement {
  RefineOutcome outcome = RefineOutcome::kNoOverlap;
  std::vector<double> moved_mm;  ///< by each round, RMS over the views
};

/// The paper's method, kept as the reference that refine_jointly is measured against: one view
/// after the other, in random order, is registered to all that overlap with it, which act as one
/// rigid metaview; again and again, until nothing moves.
/// @param views     at least one; changed are only the poses. The first view keeps its pose.
/// @param progress  advanced by one step
/// @source  Arold et al., "Global Optimization".
/// @errors  kBadOption, kInsufficient, kCancelled (poses as they were).
[[nodiscard]] Result<MetaviewRefinement> refine_by_metaviews(std::vector<AlignedView>& views,
                                                             const MetaviewRefineOptions& options,
                                                             const Progress& progress = {});

}  // namespace flytri::refinement
