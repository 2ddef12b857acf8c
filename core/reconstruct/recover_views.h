/// @file  Connects the parts of a scan that a rolling shutter has kept apart.
#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/refinement/refine.h"
#include "core/tracking/registrar.h"

namespace flytri::reconstruct {

struct RecoverOptions {
  refinement::JointRefineOptions refinement;
  tracking::Registrar::World world = tracking::Registrar::World::kFirstView;
};

/// With a rolling shutter and a fast hand, views are distorted so much that some do not fit the
/// others. The readout shows in the views that do fit. With it all views are registered again, from
/// the first on, each corrected by the motion of the hand.
///
/// @param registrar  after finish(), without edits; replaced if that finds more views
/// @param settled    the result of finish()
/// @param progress   advanced by one step
/// @return  as finish(), with the views as measured; `settled` itself if enough views are
///          connected, if the shutter is a global one, or if it was known before
/// @errors  kBadOption, kCancelled
[[nodiscard]] Result<std::vector<tracking::RegisteredView>> recover_views(
    tracking::Registrar& registrar, std::vector<tracking::RegisteredView> settled,
    const calibration::Calibration& calibration, const RecoverOptions& options,
    const Workers& workers, const Progress& progress);

}  // namespace flytri::reconstruct
