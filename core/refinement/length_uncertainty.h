/// @file  How uncertain the distances across a scan are, from the joint solution of all poses.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/view.h"
#include "core/refinement/refine.h"

namespace flytri::refinement {

/// Two places on the scanned surface, world frame.
struct Span {
  Vec3 from_mm = Vec3::Zero(), to_mm = Vec3::Zero();
  [[nodiscard]] double length_mm() const { return (to_mm - from_mm).norm(); }
};

struct LengthUncertaintyOptions {
  JointRefineOptions refinement;  ///< as the views were refined
  /// > 0. A place is what the views measured within this radius, mm: about a cusp.
  double place_mm = 2.0;
  /// > 0. Errors within a cube of this edge belong together, mm: about half a tooth.
  double cluster_mm = 3.0;

  [[nodiscard]] Result<void> validate() const;
};

/// Standard uncertainties of the lengths of spans, mm, by span. nullopt: no view saw one of its
/// ends, or nothing connects them.
///
/// Errors of the poses add up from one end to the other, as the normal equations of all poses say.
/// Their size is estimated from the residuals of whole cubes of space: neighbors may share noise.
/// Errors of the calibration are not included: they leave no residuals.
///
/// @param views  with refined poses
/// @param progress  advanced by one step
/// @source  clustered sandwich estimator: Liang and Zeger, Biometrika 73, 1986.
/// @errors  kBadOption, kInsufficient: no view, kCancelled.
[[nodiscard]] Result<std::vector<std::optional<double>>> length_uncertainties(
    std::span<const AlignedView> views, std::span<const Span> spans,
    const LengthUncertaintyOptions& options, const Workers& workers, const Progress& progress = {});

}  // namespace flytri::refinement
