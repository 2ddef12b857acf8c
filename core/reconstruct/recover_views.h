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

/// A rolling shutter and a fast hand distort views so much that some do not fit the others. Finds
/// the readout from those that fit. Then corrects and registers all views again.
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
