/// @file  Where a lost view may have been taken: start poses for registering it to the scan.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/tracking/pose_search.h"
#include "core/tracking/tracked_scan.h"

namespace flytri::tracking {

/// The points of views i - 4 to i + 4 of a submap as if all were measured from view i, sensor
/// frame. Several views fix a pose better than one.
[[nodiscard]] std::vector<Vec3> points_around(const TrackedScan& submap, std::size_t i);

class EntrySearch {
 public:
  /// Where the user is likely to resume.
  struct Hints {
    std::optional<Isometry> T_world_asked;     ///< where the user was asked to resume
    std::optional<Isometry> T_world_proposed;  ///< the best reentry proposal
    double max_gap_s = 0.5;  ///< a pose registered within this time after a view is a start for it
  };

  /// Poses that need no search: those of the hints, and those that the scan had just before and
  /// just after the view.
  /// @param scan       not empty
  /// @param radius_mm  of what the sensor sees
  [[nodiscard]] static std::vector<Isometry> likely(const TrackedScan& scan,
                                                    const IncomingView& incoming,
                                                    const Hints& hints, double radius_mm);
  /// The poses on the surface of the scan that fit best: first a few near the likely ones and the
  /// path of the scan, then `count` anywhere. A surface that looks alike in many places needs the
  /// former, a sensor that is held in another way the latter.
  /// @param points_mm  see points_around()
  [[nodiscard]] std::vector<Isometry> search(const TrackedScan& scan,
                                             const std::vector<Isometry>& likely,
                                             const std::vector<Vec3>& points_mm, double radius_mm,
                                             std::size_t count);
  /// The poses of the scan have changed.
  void forget() { surface_.reset(); }

 private:
  /// Kept until the scan changes, because many lost views use it.
  std::unique_ptr<const SurfaceMap> surface_;
  std::vector<Isometry> stops_;  ///< poses of the scan, thinned
  const TrackedScan* scan_ = nullptr;
  std::size_t views_ = 0;  ///< of the scan, in the surface
};

}  // namespace flytri::tracking
