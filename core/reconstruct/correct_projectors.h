/// @file  Corrects a scan during which a projector was knocked.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/calibration/verify/pattern_shift.h"
#include "core/refinement/refine.h"

namespace flytri::reconstruct {

/// A scan as its moved projectors show it.
struct CorrectedScan {
  std::vector<AlignedView> views;  ///< as those given; where a projector was moving, without points
  std::vector<refinement::ProjectorMotion> moved;  ///< at least one
  refinement::Refinement refinement;               ///< of these views
};

/// Finds which projector has moved, and how. Each is tried alone, since both together look like
/// another size of the surface. The better fit counts. If neither is clearly better, as after a
/// knock before the scan, nothing is corrected.
///
/// @param views    optimized, by rising time
/// @param fit      how well they fit
/// @param shifted  when the patterns disagree
/// @return  none if nothing was corrected
/// @errors  as refine_jointly().
[[nodiscard]] Result<std::optional<CorrectedScan>> correct_projectors(
    std::span<const AlignedView> views, const refinement::Refinement& fit,
    std::span<const calibration::ShiftedSpan> shifted, const calibration::Calibration& calibration,
    const refinement::JointRefineOptions& options, const Workers& workers,
    const Progress& progress);

}  // namespace flytri::reconstruct
