/// @file  How far points lie from where they belong by the error of their view's pose alone.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/view.h"

namespace flytri {

/// RMS displacement of points in two gauges, mm.
struct PoseError {
  double first_view_mm = 0.0;  ///< as it stands: the worlds agree in the first view
  double best_fit_mm = 0.0;    ///< after one rigid alignment of all points
};

/// Compares poses point by point.
/// @param estimated       aligned views; world is any frame
/// @param T_model_sensor  the true pose of each
[[nodiscard]] PoseError pose_error(std::span<const AlignedView> estimated,
                                   std::span<const Isometry> T_model_sensor);

/// RMS distance of measured points, noise included, from where the same points without noise
/// truly are, after the best rigid fit, mm.
/// @param ideal  the same views without noise, with the same points
[[nodiscard]] double point_error_mm(std::span<const AlignedView> estimated,
                                    std::span<const std::shared_ptr<const View>> ideal,
                                    std::span<const Isometry> T_model_sensor);

}  // namespace flytri
