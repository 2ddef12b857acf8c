/// @file  Closed lines of points: even spacing, and smoothing that keeps their curvature.
#pragma once

#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::review {

/// The same closed line with points at even distances, as near to `step_mm` as fits.
/// @param line_mm  at least three points; the first is not repeated
[[nodiscard]] std::vector<Vec3> evenly_spaced(const std::vector<Vec3>& line_mm, double step_mm);

/// Each point moved onto the parabola through its `reach` neighbors on both sides, in least
/// squares. A circle keeps its radius, but for terms of fourth order.
/// @param weights  by point, >= 0: inverse variances. A point farther from its parabola than
///                 `outlier_mm` counts less
/// @source  weights of outliers: the Cauchy function, Holland and Welsch, "Robust regression using
///          iteratively reweighted least-squares", 1977.
[[nodiscard]] std::vector<Vec3> smoothed(const std::vector<Vec3>& line_mm,
                                         const std::vector<double>& weights, int reach,
                                         double outlier_mm);

/// The direction of the line at each point, unit: from the neighbor `reach` before to that behind.
[[nodiscard]] std::vector<Vec3> directions(const std::vector<Vec3>& line_mm, int reach);

}  // namespace flytri::review
