/// @file  Poses from which a lost view is registered to the scan: where a hand may take it up
/// again, the likeliest first.
#pragma once

#include <optional>
#include <vector>

#include "core/tracking/tracked_scan.h"

namespace flytri::tracking {

/// Poses all over the path of a scan, far enough from each other that a start between two is near
/// to one of them. Takes a while for a long scan.
/// @param radius_mm of what the sensor sees
[[nodiscard]] std::vector<Isometry> path_stops(const TrackedScan& scan, double radius_mm);

class EntryStarts {
 public:
  /// Where the scan is likely taken up.
  struct Hints {
    std::optional<Isometry> T_world_asked;     ///< where the operator was asked to enter
    std::optional<Isometry> T_world_proposed;  ///< the best proposal
    double max_gap_s = 0.5;  ///< a scan that goes on sooner after a view tells where that was
  };

  /// @param scan      not empty; must outlive this
  /// @param stops     path_stops() of it; must outlive this
  /// @param radius_mm of what the sensor sees
  EntryStarts(const TrackedScan& scan, const std::vector<Isometry>& stops, double radius_mm,
              const Hints& hints);

  /// After the scan: all, but for what is more than `most`.
  [[nodiscard]] std::vector<Isometry> all(double time_s, std::size_t most) const;
  /// Live: the likeliest, and then a few more, by turns near those places and all over the scan, as
  /// nobody has to enter where he was asked to.
  /// @param count  of both together; one more at least
  /// @param turn   views that were lost before: goes on where the one before stopped
  [[nodiscard]] std::vector<Isometry> few(double time_s, std::size_t count, std::size_t turn) const;
  /// A start, moved along the line of sight to where the view's surface is as far from the sensor
  /// as it was when the scan saw this place: a hand comes back nearer or farther.
  [[nodiscard]] Isometry at_its_depth(const Isometry& T_world_start,
                                      const IncomingView& incoming) const;

 private:
  [[nodiscard]] std::vector<Isometry> anchors(double time_s) const;
  [[nodiscard]] std::vector<Isometry> near_anchors(double time_s) const;
  [[nodiscard]] Isometry on_path(std::size_t number) const;
  [[nodiscard]] std::vector<Isometry> likeliest() const;

  const TrackedScan& scan_;
  const std::vector<Isometry>& stops_;
  double radius_mm_;
  Hints hints_;
  std::vector<Twist> holds_;
};

}  // namespace flytri::tracking
