/// @file  Global optimization: all views of a scan are aligned together.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/view.h"
#include "core/refinement/rolling_shutter.h"
#include "core/registration/align.h"

namespace flytri::refinement {

struct JointRefineOptions {
  /// >= 0. Edge of the cells, mm. A cell has one quadric as its surface. 0: 16 times the spacing of
  /// neighboring points: large enough for lines of several views, small against a cusp.
  double cell_mm = 0.0;
  /// >= 1. Largest number of Gauss-Newton steps.
  int max_steps = 15;
  /// > 0. Prior: a step moves a view by about this share of a cell or less, so that directions that
  /// the surface hardly determines do not diverge. The converged result does not depend on it.
  double step_share = 0.25;
  /// > 0. Converged when a step changes the robust spread of the residuals by less than this share.
  /// The spread varies by about this share, because data change between cells.
  double convergence_share = 0.003;
  /// > 0. Residuals above this many robust standard deviations have weight zero.
  double tukey_sigmas = 4.0;
  /// (0, 1]. A view contradicts the others if its share of residuals with weight above zero is
  /// smaller.
  double min_inlier_share = 0.5;

  [[nodiscard]] Result<void> validate() const;
};

enum class RefineOutcome {
  kConverged,
  kStepLimit,  ///< not converged after the last step; the poses are the best ones found
  kNoOverlap   ///< no cell is seen by two views; the poses are unchanged
};
[[nodiscard]] std::string_view to_string(RefineOutcome outcome);

/// How well one view fits the common surface.
struct ViewResidual {
  std::size_t count = 0;      ///< data in cells that other views saw too
  double inlier_share = 0.0;  ///< share of these with weight above zero
  double rms_mm = 0.0;        ///< of the inliers, along the surface normal
};

struct Refinement {
  RefineOutcome outcome = RefineOutcome::kNoOverlap;
  int steps = 0;
  std::vector<double> robust_sigma_mm;  ///< of all residuals, before each step and after the last
                                        ///< step
  std::vector<ViewResidual> views;      ///< parallel to the views
  /// True if the view contradicts the others, see JointRefineOptions::min_inlier_share.
  [[nodiscard]] bool contradicts(std::size_t view, const JointRefineOptions& options) const {
    return views[view].count > 0 && views[view].inlier_share < options.min_inlier_share;
  }
};

/// Optimizes all poses together over all overlaps, V-H, V-V and H-H: in every cell of space the
/// surface is a quadric whose six parameters are eliminated. Each measured point has a residual
/// along its measurement ray. The surface as a whole stays where it was, in least squares.
///
/// The Jacobian is computed at the foot point on the quadric: at the noisy point it would bias the
/// solution. A quadric can follow each rigid motion of its cell, so a motion of the whole scan does
/// not change the residuals.
///
/// @param views     by time, at least one; only the poses change
/// @param progress  advanced by one step
/// @source  this project's; it replaces Arold et al., "Global Optimization", see
///          docs/adr/0004-joint-refinement.md.
/// @errors  kBadOption, kInsufficient: no view, kCancelled (the views have the best poses found so
///          far).
[[nodiscard]] Result<Refinement> refine_jointly(std::vector<AlignedView>& views,
                                                const JointRefineOptions& options,
                                                const Workers& workers,
                                                const Progress& progress = {});

/// A time during which a projector was not where it was calibrated.
struct ProjectorMotion {
  Pattern pattern = Pattern::kVertical;
  double from_s = 0.0, to_s = 0.0;  ///< of the views; the second is not included
  Twist motion = Twist::Zero();     ///< about the sensor's origin, sensor frame

  [[nodiscard]] bool concerns(const View& view) const {
    return view.pattern == pattern && view.time_s >= from_s && view.time_s < to_s;
  }
};

/// As refine_jointly(), with the motions of projectors as six more unknowns each, which all views
/// of their time share.
/// @param views        poses and points change: the points lie where the moved light shows them
/// @param motions      at different times, or of different patterns; only their twists change
/// @param p_camera_mm  projection center of the camera, sensor frame
/// @source  this project's, see docs/adr/0021-projector-motion.md
/// @errors  as refine_jointly(); then the points and motions do not change
[[nodiscard]] Result<Refinement> refine_with_projectors(
    std::vector<AlignedView>& views, std::vector<ProjectorMotion>& motions, const Vec3& p_camera_mm,
    const JointRefineOptions& options, const Workers& workers, const Progress& progress = {});

/// Estimates the readout from views whose poses are optimized without one. The velocities of the
/// sensor follow from the poses.
/// @param views  by time, at least one
/// @return  of one step of the solution: to some percent
/// @source  this project's, see docs/adr/0023-rolling-shutter.md
/// @errors  kBadOption, kInsufficient, kCancelled
[[nodiscard]] Result<Readout> estimate_readout(std::span<const AlignedView> views,
                                               const trajectory::RowShare& row_share,
                                               const JointRefineOptions& options,
                                               const Workers& workers,
                                               const Progress& progress = {});

/// As refine_jointly(), with the readout as one more unknown, which all views share.
/// @param views    poses and points change: the points lie where they were at their view's time
/// @param readout  where the search begins; then the result
/// @source  this project's, see docs/adr/0023-rolling-shutter.md
/// @errors  as refine_jointly(); then points and readout do not change
[[nodiscard]] Result<Refinement> refine_with_readout(
    std::vector<AlignedView>& views, Readout& readout, const trajectory::RowShare& row_share,
    const JointRefineOptions& options, const Workers& workers, const Progress& progress = {});

struct MetaviewRefineOptions {
  /// For aligning one view to its metaview. The guess is near, so there is no coarse stage.
  registration::AlignOptions align;
  /// >= 1. Largest number of rounds. A round registers every view once.
  int max_rounds = 20;
  /// > 0. Converged when a round moves the views by less than this share of a view's radius (RMS).
  double convergence_share = 2e-5;
  /// Seed of the order of the views.
  std::uint64_t seed = 1;

  [[nodiscard]] Result<void> validate() const;
};

struct MetaviewRefinement {
  RefineOutcome outcome = RefineOutcome::kNoOverlap;
  std::vector<double> moved_mm;  ///< motion in each round, RMS over the views
};

/// The paper's method, used as the reference for refine_jointly: registers the views one by one, in
/// random order, each to all overlapping views as one rigid metaview. Repeats this until the views
/// no longer move.
/// @param views     at least one; only the poses change. The first view keeps its pose.
/// @param progress  advanced by one step
/// @source  Arold et al., "Global Optimization".
/// @errors  kBadOption, kInsufficient, kCancelled (poses unchanged).
[[nodiscard]] Result<MetaviewRefinement> refine_by_metaviews(std::vector<AlignedView>& views,
                                                             const MetaviewRefineOptions& options,
                                                             const Progress& progress = {});

}  // namespace flytri::refinement
