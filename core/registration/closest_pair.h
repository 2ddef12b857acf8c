/// @file  Where two profiles come closest: over all knots exactly, then between them on the curves.
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

/// Reference: compares every knot with every other, N². Of equals the first by (k, l) is taken.
/// @source  Arold et al., "Corresponding Points".
[[nodiscard]] std::optional<KnotPair> closest_knots_brute_force(const CubicCurve& first,
                                                                const CubicCurve& second,
                                                                double max_distance_mm);

/// The same pair by branch and bound over the boxes of both curves: hierarchical, and restricted to
/// max_distance_mm; it gives up at the first level if the curves do not come that near.
/// @source  Arold et al., "Corresponding Points".
[[nodiscard]] std::optional<KnotPair> closest_knots(const PreparedProfile& first,
                                                    const PreparedProfile& second,
                                                    double max_distance_mm);

/// Closest points of two curves, to a fraction of the knot spacing.
struct CurvePair {
  double x = 0, y = 0;  ///< places on the first and second curve
  CurvePoint p, q;      ///< there; p in the frame of the second curve
  bool inside = false;  ///< neither is an end: the curves cross, seen along p - q
};

/// Walks from (x, y) to the nearest local minimum of the distance (Gauss-Newton in both places).
/// @param T_second_first  the first curve is seen through this motion.
[[nodiscard]] CurvePair refine_on_curves(const CubicCurve& first, const CubicCurve& second,
                                         const Isometry& T_second_first, double x, double y);

}  // namespace flytri::registration
