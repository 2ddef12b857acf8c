/// @file  Proposes where to resume a lost scan.
#pragma once

#include <optional>
#include <vector>

#include "core/tracking/tracked_scan.h"

namespace flytri::tracking {

/// Two successive views with many profiles and points.
/// @source  Arold et al., "Preview and Continuation Mode".
struct ReentryProposal {
  AlignedView first, second;
  std::size_t point_count = 0;  ///< the rating: sum over both
};

/// The best of the latest pairs; nullopt before two views are registered.
[[nodiscard]] std::optional<ReentryProposal> propose_reentry(const TrackedScan& scan,
                                                             int latest_pairs);

/// That proposal, then others along the whole scan, at least `apart_mm` from each other, by falling
/// rating.
/// @param apart_mm  also the lever arm that converts rotation to distance
[[nodiscard]] std::vector<ReentryProposal> propose_reentries(const TrackedScan& scan,
                                                             int latest_pairs, std::size_t count,
                                                             double apart_mm);

}  // namespace flytri::tracking
