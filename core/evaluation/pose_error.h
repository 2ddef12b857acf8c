/// @file  Displacement of points that is caused by pose errors only.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/rigid.h"
#include "core/geometry/view.h"

namespace flytri::evaluation {

/// The estimated and the true pose of one view.
struct PosePair {
  Isometry T_world_sensor = Isometry::Identity();  ///< estimated; world is any frame
  Isometry T_model_sensor = Isometry::Identity();  ///< true
};

/// RMS displacement of points that are fixed in the sensor frame, for two choices of the world
/// frame (gauges), mm.
struct PoseError {
  double first_view_mm = 0.0;  ///< the world frames agree in the first view
  double best_fit_mm = 0.0;    ///< after the rigid motion of all points that minimizes it
};

/// Displacement of the same points in every view; 0 if there are none.
/// @param views      by rising time
/// @param points_mm  sensor frame; e.g. the corners of the measurement volume
[[nodiscard]] PoseError pose_error(std::span<const PosePair> views,
                                   std::span<const Vec3> points_mm);

/// Same, for a given gauge.
/// @returns RMS displacement, mm; 0 without views.
[[nodiscard]] double pose_error_mm(std::span<const PosePair> views, const Isometry& T_model_world,
                                   std::span<const Vec3> points_mm);

/// The eight corners of a box around the origin of the sensor frame.
/// @param size_mm  edge lengths along x, y, z
[[nodiscard]] std::vector<Vec3> volume_corners(const Vec3& size_mm);

/// Displacement of the measured points of each view; 0 if there are none.
/// @param estimated       aligned views by rising time; world is any frame
/// @param T_model_sensor  the true pose of each
[[nodiscard]] PoseError pose_error(std::span<const AlignedView> estimated,
                                   std::span<const Isometry> T_model_sensor);

/// The same for each view alone, after the rigid motion that fits all views best, mm.
/// @returns parallel to `estimated`
[[nodiscard]] std::vector<double> pose_errors_by_view_mm(std::span<const AlignedView> estimated,
                                                         std::span<const Isometry> T_model_sensor);

/// RMS distance of measured points (with noise) from the true positions of the same points without
/// noise, after the best rigid fit, mm.
/// @param ideal  the same views without noise, with the same points
[[nodiscard]] double point_error_mm(std::span<const AlignedView> estimated,
                                    std::span<const std::shared_ptr<const View>> ideal,
                                    std::span<const Isometry> T_model_sensor);

}  // namespace flytri::evaluation
