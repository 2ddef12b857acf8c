/// @file  Tells a right pose from a wrong one: how many places of a view agree with the metaview.
#pragma once

#include <span>

#include "core/registration/crossings.h"

namespace flytri::registration {

/// Crossings, counted by places: cells of the source as its sensor sees it. Neighboring crossings
/// share noise and shape, so that only places count as independent.
struct Agreement {
  int places = 0;              ///< that hold a crossing
  int agreeing = 0;            ///< in which more crossings agree than do not
  double proof = 0.0;          ///< what speaks for the pose, >= 0
  double contradiction = 0.0;  ///< what speaks against it, >= 0
  double evidence = 0.0;  ///< natural logarithm of the odds that the pose is right: see judge()
};

struct AgreementOptions {
  /// Default 5, range [2, 20]. Standard uncertainties within which a crossing agrees: three for
  /// noise that is correlated along the lines, which the stated uncertainty takes for white.
  double max_sigmas = 5.0;
  /// Default 0.001, range [0, 0.1], as a share of the source's radius. So near, crossings agree
  /// however certain they are: what calibration and splines leave is not in their uncertainty.
  double min_distance_share = 0.001;
  /// Default 0.16, range (0, 1]. Side of a place, as a share of the source's radius: half of the
  /// distance of neighboring lines.
  double place_share = 0.16;

  [[nodiscard]] Result<void> validate() const;
};

/// Compares two hypotheses by their likelihood. If the pose is right, a place agrees with
/// probability 0.95: the rest are depth steps and shadows. If it is wrong, two surfaces that were
/// pressed against each other pass through each other, and half of the places lie near their line
/// of contact. The fit itself makes six places agree under either; they prove nothing.
///
///   evidence = proof - contradiction
///            = (agreeing - 6) ln(0.95 / 0.5) - (places - agreeing) ln(0.5 / 0.05)
///
/// @param crossings  all that the search found, also those that a robust fit would drop, with
///                   their distances at the final pose.
/// @param T_world_source  of that pose: crossings are in the metaview's frame.
/// @param radius_mm  of the source.
/// @source  Wald, "Sequential tests of statistical hypotheses", 1945.
[[nodiscard]] Agreement judge(std::span<const Crossing> crossings, const Isometry& T_world_source,
                              double radius_mm, const AgreementOptions& options = {});

}  // namespace flytri::registration
