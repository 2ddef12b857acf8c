/// @file  Aligns a view to another view or to a metaview: ICP on crossing line profiles.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/result.h"
#include "core/registration/agreement.h"
#include "core/registration/pose_solver.h"

namespace flytri::registration {

/// How an alignment ended. Only kAligned gives a reliable pose.
enum class AlignOutcome {
  kAligned,
  kTooFewCrossings,  ///< the views do not overlap enough, or have too few lines
  kUndetermined,     ///< the surface does not determine all six degrees of freedom: flat, round, or
                     ///< a ridge
  kPoorFit,          ///< too many crossings do not agree with the pose
  kNotConverged      ///< still moving after the last iteration
};

[[nodiscard]] std::string_view to_string(AlignOutcome outcome);

/// A pose that is known with some uncertainty.
struct KnownPose {
  Isometry T_target_source = Isometry::Identity();
  Matrix6 information = Matrix6::Zero();  ///< in the unknowns of StepFrame, mm^-2
};

/// Lengths are shares of the source view's radius (RMS distance of its points from their center),
/// so that the same values serve every sensor.
struct AlignOptions {
  /// Default 0.2, range (0, 2]. d_max of the first iteration; it shrinks with the residuals.
  double start_distance_share = 0.2;
  /// Default 0.02, range (0, start_distance_share]. d_max does not shrink below this.
  double final_distance_share = 0.02;
  /// Default 250, >= 20, or 0. Number of random profile pairs in the first, coarse stage. 0 skips
  /// this stage, for a guess that is already an alignment.
  int coarse_pairs = 250;
  /// Default 1000, >= 20, >= coarse_pairs. Number of random profile pairs in the last stage.
  int fine_pairs = 1000;
  /// Default 12, >= 2. Iterations of each stage.
  int max_iterations = 12;
  /// Default 12, >= 6. Fewer crossings: kTooFewCrossings.
  int min_crossings = 12;
  /// Default 7, range [0, 1000]. Least evidence for the pose, see judge(): odds of e^7, about 1000
  /// to 1.
  double min_evidence = 7.0;
  AgreementOptions agreement;
  /// Default 0.015, range (0, 1). Largest standard uncertainty in the worst direction.
  double max_uncertainty_share = 0.015;
  /// Default 0.35. See CrossingLimits::min_crossing_sine.
  double min_crossing_sine = 0.35;
  ResidualKind residual = ResidualKind::kAlongNormal;
  CrossingWeight weight = CrossingWeight::kUncertainty;
  /// Expected error of the guess. Zero: start_distance_share of the radius for each direction.
  PosePrior prior{0.0, 0.0};
  /// What is known of the pose beside the views: then it counts in place of `prior`, and the
  /// uncertainty that must not be too large is that of both together.
  std::optional<KnownPose> known;
  /// Seed of the random subsets.
  std::uint64_t seed = 1;

  [[nodiscard]] Result<void> validate() const;
};

/// A pose and its quality.
struct Alignment {
  AlignOutcome outcome = AlignOutcome::kTooFewCrossings;
  Isometry T_target_source = Isometry::Identity();
  int iterations = 0;
  int crossings = 0;          ///< used in the last iteration
  double inlier_share = 0.0;  ///< of these, within three robust sigmas
  double rms_mm = 0.0;        ///< of the inliers
  double uncertainty_mm = 0;  ///< standard uncertainty in the worst of the six directions
  /// Of the crossings alone, in the unknowns of StepFrame (target frame), mm^-2.
  Matrix6 information = Matrix6::Zero();
  bool is_held = false;      ///< in some direction by what was known beside the views
  Agreement agreement;       ///< at the final pose
  double moved_mm = 0.0;     ///< RMS displacement of the source's points from the guess
  double covered_share = 0;  ///< share of the source's profile length with inlier crossings

  [[nodiscard]] bool aligned() const { return outcome == AlignOutcome::kAligned; }
};

/// Moves `source` onto `target`.
/// @source  Arold et al., "Single Registration"; unless the options select the paper's way,
///          distances are minimized along the normal of the crossing and weighted by their
///          uncertainty.
/// @errors  kBadOption. All else is reported as an outcome.
[[nodiscard]] Result<Alignment> align_view(const PreparedView& source, const PreparedView& target,
                                           const Isometry& T_target_source_guess,
                                           const AlignOptions& options = {});

/// Moves `source` onto all views of `metaview`, which stay where they are.
/// @source  Arold et al., "Multi-View Registration".
/// @errors  kBadOption.
[[nodiscard]] Result<Alignment> align_to_metaview(const PreparedView& source, Metaview metaview,
                                                  const Isometry& T_world_source_guess,
                                                  const AlignOptions& options = {});

}  // namespace flytri::registration
