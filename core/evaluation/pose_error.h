/// @file  How far points lie from where they belong by the error of their view's pose alone.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/rigid.h"
#include "core/geometry/view.h"

namespace flytri::evaluation {

/// One view's pose as it was found, and as it was.
struct PosePair {
  Isometry T_world_sensor = Isometry::Identity();  ///< found; world is any frame
  Isometry T_model_sensor = Isometry::Identity();  ///< true
};

/// RMS displacement of points that are fixed in their sensor, in two gauges, mm.
struct PoseError {
  double first_view_mm = 0.0;  ///< as it stands: the worlds agree in the first view
  double best_fit_mm = 0.0;    ///< after the rigid motion of all points that makes it least
};

/// Displacement of the same points in every view; 0 where there are none.
/// @param views      by rising time
/// @param points_mm  sensor frame; e.g. the corners of the measurement volume
[[nodiscard]] PoseError pose_error(std::span<const PosePair> views,
                                   std::span<const Vec3> points_mm);

/// The same in a gauge that is given.
/// @returns RMS displacement, mm; 0 where there are no views.
[[nodiscard]] double pose_error_mm(std::span<const PosePair> views, const Isometry& T_model_world,
                                   std::span<const Vec3> points_mm);

/// The eight corners of a box around the origin of the sensor frame.
/// @param size_mm  edge lengths along x, y, z
[[nodiscard]] std::vector<Vec3> volume_corners(const Vec3& size_mm);

/// Displacement of the points that each view measured; 0 where there are none.
/// @param estimated       aligned views by rising time; world is any frame
/// @param T_model_sensor  the true pose of each
[[nodiscard]] PoseError pose_error(std::span<const AlignedView> estimated,
                                   std::span<const Isometry> T_model_sensor);

/// RMS distance of measured points, noise included, from where the same points without noise
/// truly are, after the best rigid fit, mm.
/// @param ideal  the same views without noise, with the same points
[[nodiscard]] double point_error_mm(std::span<const AlignedView> estimated,
                                    std::span<const std::shared_ptr<const View>> ideal,
                                    std::span<const Isometry> T_model_sensor);

}  // namespace flytri::evaluation
