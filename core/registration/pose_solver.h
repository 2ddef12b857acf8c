/// @file  One step of registration: the small motion that brings crossings together, and how well
/// each of its six directions is known.
#pragma once

#include <span>
#include <vector>

#include "core/registration/crossings.h"

namespace flytri::registration {

/// What the least squares makes small.
enum class ResidualKind {
  kAlongNormal,  ///< distance along o_k x o_l: the points may slide on the surface
  kPointToPoint  ///< the whole vector between the points, as in the paper
};

/// How crossings are weighted against each other.
enum class CrossingWeight {
  kUncertainty,    ///< inverse variance of the measured distance
  kDepthVariation  ///< sum of the depth variations of both profiles, as in the paper
};

/// How far the guess may be off: standard uncertainties about the source's center.
struct PosePrior {
  double rotation_rad = 0.05;
  double translation_mm = 0.5;
};

/// Where the step is taken: rotations turn about `center_mm` and are scaled by `radius_mm`, so that
/// all six unknowns are millimetres of the view's points.
struct StepFrame {
  Vec3 center_mm;
  double radius_mm = 1.0;
};

/// A step and what is known about it. Unknowns: (radius * rotation vector, translation), mm.
struct PoseStep {
  Twist motion_mm = Twist::Zero();
  Twist sigma_mm = Twist::Constant(1e30);  ///< along the eigenvectors, from the crossings alone
  double significance = 1e30;              ///< size of the motion in standard uncertainties
  double noise_scale = 1.0;   ///< residuals in units of their expected uncertainty, robust
  double inlier_share = 0.0;  ///< crossings that lie within 3 of these
  double rms_mm = 0.0;        ///< of the inliers' distances
};

struct StepOptions {
  ResidualKind residual = ResidualKind::kAlongNormal;
  CrossingWeight weight = CrossingWeight::kUncertainty;
  PosePrior prior;
};

/// @param moved_mm  motion already made since the guess, in the same unknowns: the prior pulls
///                  towards zero of it.
/// Directions that the crossings do not determine beyond the noise of their normals are left to the
/// prior: noisy normals pretend to know how a flat surface slides in itself.
/// @source  Arold et al., "Single Registration"; robust weights: Geman and McClure, 1987.
[[nodiscard]] PoseStep solve_step(std::span<const Crossing> crossings, const StepFrame& frame,
                                  const Twist& moved_mm, const StepOptions& options);

/// The rigid motion of a step, in the frame of the crossings.
[[nodiscard]] Isometry motion_of(const Twist& motion_mm, const StepFrame& frame);

/// Inverse of motion_of().
[[nodiscard]] Twist unknowns_of(const Isometry& T_moved, const StepFrame& frame);

}  // namespace flytri::registration
