/// @file  Aligns one view to another, or to many that act as one: ICP on crossing line profiles.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/result.h"
#include "core/registration/agreement.h"
#include "core/registration/pose_solver.h"

namespace flytri::registration {

/// How an alignment ended. Only kAligned gives a pose to rely on.
enum class AlignOutcome {
  kAligned,
  kTooFewCrossings,  ///< the views do not overlap enough, or have too few lines
  kUndetermined,     ///< the surface does not fix all six directions: flat, round, or a ridge
  kPoorFit,          ///< crossings were found, but they do not agree on one pose
  kNotConverged      ///< still moving after the last iteration
};

[[nodiscard]] std::string_view to_string(AlignOutcome outcome);

/// Lengths are shares of the source view's radius (RMS distance of its points from their center),
/// so that the same values serve every sensor.
struct AlignOptions {
  /// Default 0.2, range (0, 2]. d_max of the first iteration; it shrinks with the residuals.
  double start_distance_share = 0.2;
  /// Default 0.02, range (0, start_distance_share]. d_max does not shrink below this.
  double final_distance_share = 0.02;
  /// Default 250, >= 20, or 0. Random subset of profile pairs that the first, coarse stage uses; 0
  /// leaves it out, for a guess that is itself an alignment.
  int coarse_pairs = 250;
  /// Default 1000, >= 20, >= coarse_pairs. Random subset of the last stage.
  int fine_pairs = 1000;
  /// Default 12, >= 2. Iterations of each stage.
  int max_iterations = 12;
  /// Default 12, >= 6. Fewer crossings: kTooFewCrossings.
  int min_crossings = 12;
  /// Default 7, range [0, 1000]. Evidence that the pose must have, see judge(): at least e^7 = 1000
  /// to 1 for it.
  double min_evidence = 7.0;
  AgreementOptions agreement;
  /// Default 0.015, range (0, 1). Standard uncertainty of the worst direction, at most.
  double max_uncertainty_share = 0.015;
  /// Default 0.35. See CrossingLimits::min_crossing_sine.
  double min_crossing_sine = 0.35;
  ResidualKind residual = ResidualKind::kAlongNormal;
  CrossingWeight weight = CrossingWeight::kUncertainty;
  /// How far the guess may be off. Zero: start_distance_share of the radius for each direction.
  PosePrior prior{0.0, 0.0};
  /// Seed of the random subsets.
  std::uint64_t seed = 1;

  [[nodiscard]] Result<void> validate() const;
};

/// A pose and how far to trust it.
struct Alignment {
  AlignOutcome outcome = AlignOutcome::kTooFewCrossings;
  Isometry T_target_source = Isometry::Identity();
  int iterations = 0;
  int crossings = 0;          ///< used in the last iteration
  double inlier_share = 0.0;  ///< of these, within three robust sigmas
  double rms_mm = 0.0;        ///< of the inliers
  double uncertainty_mm = 0;  ///< standard, of the worst of the six directions
  Agreement agreement;        ///< at the final pose
  double moved_mm = 0.0;      ///< RMS displacement of the source's points from the guess
  double covered_share = 0;   ///< of the source's profiles, by length, that have inlying crossings

  [[nodiscard]] bool aligned() const { return outcome == AlignOutcome::kAligned; }
};

/// Moves `source` onto `target`.
/// @source  Arold et al., "Single Registration"; distances are minimized along the normal of the
///          crossing and weighted by their uncertainty unless the options say as the paper does.
/// @errors  kBadOption. Everything else is an outcome.
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
