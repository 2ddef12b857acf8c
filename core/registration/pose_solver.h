/// @file  One registration step: the small motion that minimizes the distances at the crossings,
///          and its uncertainty in six directions.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry/decompositions.h"
#include "core/registration/crossings.h"

namespace flytri::registration {

/// What the least-squares fit minimizes.
enum class ResidualKind {
  kAlongNormal,  ///< distance along o_k x o_l: points may slide along the surface
  kPointToPoint  ///< the whole vector between the points, as in the paper
};

/// How crossings are weighted against each other.
enum class CrossingWeight {
  kUncertainty,    ///< inverse variance of the measured distance
  kDepthVariation  ///< sum of the depth variations of both profiles, as in the paper
};

/// Expected error of the guess: standard uncertainties about the source's center.
struct PosePrior {
  double rotation_rad = 0.05;
  double translation_mm = 0.5;
};

/// Frame of the step: rotations are about `center_mm` and scaled by `radius_mm`, so that all six
/// unknowns are displacements in mm.
struct StepFrame {
  Vec3 center_mm;
  double radius_mm = 1.0;
};

/// A step and its quality. Unknowns: (radius * rotation vector, translation), mm.
struct PoseStep {
  Twist motion_mm = Twist::Zero();
  Twist sigma_mm = Twist::Constant(1e30);  ///< along the eigenvectors, from the crossings alone
  Matrix6 information = Matrix6::Zero();   ///< of the crossings alone, mm^-2
  bool is_open =
      false;  ///< in some direction, what seems to be structure may be noise of the normals
  double significance = 1e30;  ///< size of the motion in standard uncertainties
  double noise_scale = 1.0;    ///< robust ratio of residuals to their expected uncertainty
  double inlier_share = 0.0;   ///< share of crossings within 3 sigmas of these
  double rms_mm = 0.0;         ///< of the inliers' distances
};

struct StepOptions {
  ResidualKind residual = ResidualKind::kAlongNormal;
  CrossingWeight weight = CrossingWeight::kUncertainty;
  PosePrior prior;
  /// What is known of the pose beside the crossings, mm^-2, instead of `prior`. It is weighed
  /// against the crossings in all directions: those that they hardly determine are not left to it
  /// alone.
  std::optional<Matrix6> known;
};

/// Computes one step. Only the prior decides in directions that the crossings do not determine:
/// without this rule, noisy normals would seem to determine how a flat surface slides along itself.
/// @param moved_mm  motion since the guess, in the same unknowns. The prior pulls it towards zero.
/// @source  Arold et al., "Single Registration"; robust weights: Geman and McClure, 1987.
[[nodiscard]] PoseStep solve_step(std::span<const Crossing> crossings, const StepFrame& frame,
                                  const Twist& moved_mm, const StepOptions& options);

/// Standard uncertainty in the worst direction of a pose that is known so well.
[[nodiscard]] double worst_sigma_mm(const Matrix6& information);

/// The rigid motion of a step, in the frame of the crossings.
[[nodiscard]] Isometry motion_of(const Twist& motion_mm, const StepFrame& frame);

/// Inverse of motion_of().
[[nodiscard]] Twist unknowns_of(const Isometry& T_moved, const StepFrame& frame);

}  // namespace flytri::registration
