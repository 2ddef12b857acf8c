/// @file  Decides if a pose is right: counts the places of a view that agree with the metaview.
#pragma once

#include <span>

#include "core/registration/crossings.h"

namespace flytri::registration {

/// Crossings counted by place. A place is a cell in x and y of the source's sensor frame.
/// Neighboring crossings share noise and shape, so only places count as independent.
struct Agreement {
  int places = 0;              ///< places with a crossing
  int agreeing = 0;            ///< places in which most crossings agree
  double proof = 0.0;          ///< evidence for the pose, >= 0
  double contradiction = 0.0;  ///< evidence against the pose, >= 0
  double evidence = 0.0;  ///< natural logarithm of the odds that the pose is right: see judge()
};

struct AgreementOptions {
  /// Default 5, range [2, 20]. A crossing agrees if its distance is within this many standard
  /// uncertainties. More than three, because the noise is correlated along the lines, while the
  /// uncertainty assumes white noise.
  double max_sigmas = 5.0;
  /// Default 0.001, range [0, 0.1], as a share of the source's radius. Crossings within this
  /// distance always agree: their uncertainty does not include the errors of calibration and
  /// splines.
  double min_distance_share = 0.001;
  /// Default 0.16, range (0, 1]. Side of a place, as a share of the source's radius: half of the
  /// distance of neighboring lines.
  double place_share = 0.16;

  [[nodiscard]] Result<void> validate() const;
};

/// Compares two hypotheses by their likelihood. If the pose is right, a place agrees with
/// probability 0.95; the rest are depth steps and shadows. If it is wrong, the fitted surfaces
/// intersect, and about half of the places are near the intersection and agree. The fit of six
/// parameters makes six places agree in both cases, so these do not count.
///
///   evidence = proof - contradiction
///            = (agreeing - 6) ln(0.95 / 0.5) - (places - agreeing) ln(0.5 / 0.05)
///
/// @param crossings  all crossings of the search, including those that a robust fit ignores, with
///                   their distances at the final pose.
/// @param T_world_source  of that pose: crossings are in the metaview's frame.
/// @param radius_mm  of the source.
/// @source  Wald, "Sequential tests of statistical hypotheses", 1945.
[[nodiscard]] Agreement judge(std::span<const Crossing> crossings, const Isometry& T_world_source,
                              double radius_mm, const AgreementOptions& options = {});

}  // namespace flytri::registration
