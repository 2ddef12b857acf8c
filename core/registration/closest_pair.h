/// @file  Closest points of two profiles: first the closest knots, then a refinement on the curves.
#pragma once

#include <optional>

#include "core/registration/prepared_view.h"

namespace flytri::registration {

/// The closest knots of two curves.
struct KnotPair {
  std::size_t k = 0;  ///< knot of the first curve
  std::size_t l = 0;  ///< knot of the second
  float squared_distance_mm2 = 0;
};

/// Reference implementation: compares all pairs of knots, O(N²). Among equally close pairs, the
/// first by (k, l) is taken.
/// @source  Arold et al., "Corresponding Points".
[[nodiscard]] std::optional<KnotPair> closest_knots_brute_force(const CubicCurve& first,
                                                                const CubicCurve& second,
                                                                double max_distance_mm);

/// The same pair by branch and bound over the boxes of both curves: hierarchical and limited to
/// max_distance_mm. It stops at the first level if the boxes are farther apart.
/// @source  Arold et al., "Corresponding Points".
[[nodiscard]] std::optional<KnotPair> closest_knots(const PreparedProfile& first,
                                                    const PreparedProfile& second,
                                                    double max_distance_mm);

/// Closest points of two curves, to a fraction of the knot spacing.
struct CurvePair {
  double x = 0, y = 0;  ///< places on the first and second curve
  CurvePoint p, q;      ///< the points at x and y; p in the frame of the second curve
  bool inside = false;  ///< neither is an end of its curve: seen along p - q, the curves cross
};

/// Finds the nearest local minimum of the distance, starting at (x, y): Gauss-Newton in x and y.
/// @param T_second_first  applied to the first curve.
[[nodiscard]] CurvePair refine_on_curves(const CubicCurve& first, const CubicCurve& second,
                                         const Isometry& T_second_first, double x, double y);

}  // namespace flytri::registration
