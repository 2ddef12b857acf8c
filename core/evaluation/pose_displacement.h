/// @file  How far errors of the poses alone move what the views measured.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace flytri {

/// One view's pose as it was found, and as it was.
struct PosePair {
  Isometry T_world_sensor = Isometry::Identity();  ///< found
  Isometry T_model_sensor = Isometry::Identity();  ///< true
};

/// RMS displacement of points that are fixed in the sensor, over all views, mm.
struct PoseDisplacement {
  double first_view_mm = 0.0;  ///< the first view is taken as right: the drift since then
  double best_fit_mm = 0.0;    ///< after the rigid motion that makes the RMS least: what stays in
                               ///< the shape
};

/// @param views      by rising time; the first one ties world and model together
/// @param points_mm  sensor frame; e.g. the corners of the measurement volume
/// @errors  kInsufficient: no view, or fewer than three points.
[[nodiscard]] Result<PoseDisplacement> pose_displacement(const std::vector<PosePair>& views,
                                                         const std::vector<Vec3>& points_mm);

/// The eight corners of a box around the origin of the sensor frame.
/// @param size_mm  edge lengths along x, y, z
[[nodiscard]] std::vector<Vec3> volume_corners(const Vec3& size_mm);

}  // namespace flytri
