/// @file  Start poses for registering a lost view to the scan: where the user may resume, the most
///          likely first.
#pragma once

#include <optional>
#include <vector>

#include "core/tracking/tracked_scan.h"

namespace flytri::tracking {

/// Poses along the whole path of a scan, thinned so that neighbors are not too close. Takes time
/// for a long scan.
/// @param radius_mm of what the sensor sees
[[nodiscard]] std::vector<Isometry> path_stops(const TrackedScan& scan, double radius_mm);

class EntryStarts {
 public:
  /// Where the user is likely to resume.
  struct Hints {
    std::optional<Isometry> T_world_asked;     ///< where the user was asked to resume
    std::optional<Isometry> T_world_proposed;  ///< the best reentry proposal
    double max_gap_s = 0.5;  ///< a pose registered within this time after a view is a start for it
  };

  /// @param scan      not empty; must outlive this
  /// @param stops     path_stops() of it; must outlive this
  /// @param radius_mm of what the sensor sees
  EntryStarts(const TrackedScan& scan, const std::vector<Isometry>& stops, double radius_mm,
              const Hints& hints);

  /// After the scan: all start poses, at most `most`.
  [[nodiscard]] std::vector<Isometry> all(double time_s, std::size_t most) const;
  /// Live: the most likely start poses, then a few more, alternating between places near them and
  /// places along the whole scan, because the user may resume elsewhere.
  /// @param count  number of start poses; at least one comes after the most likely ones
  /// @param turn   number of lost views so far: continues the list where the previous call stopped
  [[nodiscard]] std::vector<Isometry> few(double time_s, std::size_t count, std::size_t turn) const;
  /// The start pose moved along the line of sight, so that the view's surface has the distance from
  /// the sensor that it had in the nearest registered view: the user may resume nearer or farther.
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
