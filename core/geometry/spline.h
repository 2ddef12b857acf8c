/// @file  Cubic spline curves through points in space.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri {

/// A place on a curve. x = 3.5 lies in the middle between knots 3 and 4.
struct CurvePoint {
  Vec3 position_mm;
  Vec3 derivative_mm;  ///< of the position by x: along the tangent; its length jumps at knots
};

/// A twice continuously differentiable cubic spline through its knots (natural ends), stored as
/// cubic Hermite segments. Positions are in the frame of the input points.
///
/// Knots are stored in single precision, because a scan has millions of them: at 500 mm it still
/// resolves 0.03 µm.
class CubicCurve {
 public:
  CubicCurve() = default;
  /// @param parameters  strictly rising, one for each point; only ratios of distances matter.
  /// @param points_mm   at least two.
  CubicCurve(std::span<const double> parameters, std::span<const Vec3> points_mm);

  [[nodiscard]] std::size_t knot_count() const { return knots_.size(); }
  /// Largest x at which the curve can be evaluated.
  [[nodiscard]] double end() const { return static_cast<double>(knots_.size()) - 1.0; }
  [[nodiscard]] const Vec3f& knot_mm(std::size_t i) const { return knots_[i].position_mm; }

  /// @param x  0..end(); clamped.
  [[nodiscard]] CurvePoint at(double x) const;

  /// Transforms the curve from frame b to frame a.
  void transform(const Isometry& T_a_b);

 private:
  struct Knot {
    Vec3f position_mm;
    Vec3f slope;     ///< derivative by the parameter, mm per unit of parameter
    float step = 0;  ///< parameter distance to the next knot
  };
  std::vector<Knot> knots_;
};

}  // namespace flytri
