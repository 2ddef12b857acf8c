/// @file  Proposes where to resume a lost scan.
#pragma once

#include <optional>
#include <vector>

#include "core/tracking/tracked_scan.h"

namespace flytri::tracking {

/// Two successive views at a place where the surface fixes the pose of the sensor well: with
/// cusps, not a flat palate. The paper takes those with most points, which may be flat.
/// @source  Arold et al., "Preview and Continuation Mode".
struct ReentryProposal {
  AlignedView first, second;
  double uncertainty_mm = 0.0;  ///< the rating: of the pose that is fixed worse, in its worst
                                ///< direction
};

/// The best of the latest pairs; nullopt before two views are registered.
[[nodiscard]] std::optional<ReentryProposal> propose_reentry(TrackedScan& scan, int latest_pairs);

/// That proposal, then others along the whole scan, at least `apart_mm` from each other, by rising
/// uncertainty.
/// @param apart_mm  also the lever arm that converts rotation to distance
[[nodiscard]] std::vector<ReentryProposal> propose_reentries(TrackedScan& scan, int latest_pairs,
                                                             std::size_t count, double apart_mm);

}  // namespace flytri::tracking
