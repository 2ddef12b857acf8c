/// @file  Searches the whole scanned surface for the pose of a lost sensor.
#pragma once

#include <span>
#include <vector>

#include "core/tracking/surface_map.h"

namespace flytri::tracking {

/// A pose at which a view may have been taken.
struct PoseGuess {
  Isometry T_world_sensor = Isometry::Identity();
  double off_mm = 0.0;  ///< mean distance of the points from the surface, each cut off
};

/// The poses at which the points fit the surface best: the best first, each different from the
/// others. Tries every place of the surface, every roll, and tilts of up to about 60 degrees from
/// the sight of the scan. Exact enough to start TrackedScan::locate.
/// @param points_mm  measured from one place, sensor frame
/// @param radius_mm  of what the sensor sees
[[nodiscard]] std::vector<PoseGuess> search_poses(const SurfaceMap& map,
                                                  std::span<const Vec3> points_mm, double radius_mm,
                                                  std::size_t count);

/// The best fits that are reached from given poses, apart from each other, the best first.
[[nodiscard]] std::vector<PoseGuess> improve_poses(const SurfaceMap& map,
                                                   const std::vector<Isometry>& T_world_starts,
                                                   std::span<const Vec3> points_mm,
                                                   double radius_mm, std::size_t count);

}  // namespace flytri::tracking
