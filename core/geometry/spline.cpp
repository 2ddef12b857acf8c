#include "core/geometry/spline.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace flytri {
namespace {

/// Slopes of the natural spline: the tridiagonal system that makes the second derivative
/// continuous at every inner knot and zero at both ends.
std::vector<Vec3> natural_slopes(std::span<const double> parameters, std::span<const Vec3> points) {
  const std::size_t n = points.size();
  std::vector<double> upper(n);
  std::vector<Vec3> slopes(n);
  const auto step = [&](std::size_t i) { return parameters[i + 1] - parameters[i]; };
  const auto chord = [&](std::size_t i) -> Vec3 { return (points[i + 1] - points[i]) / step(i); };

  upper[0] = 0.5;
  slopes[0] = 1.5 * chord(0);
  for (std::size_t i = 1; i < n; ++i) {
    const bool last = i + 1 == n;
    const double lower = 1.0 / step(i - 1);
    const double above = last ? 0.0 : 1.0 / step(i);
    Vec3 right = 3.0 * lower * chord(i - 1);
    if (!last) right += 3.0 * above * chord(i);
    const double pivot = 2.0 * (lower + above) - lower * upper[i - 1];
    upper[i] = above / pivot;
    slopes[i] = (right - lower * slopes[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 0;) slopes[i] -= upper[i] * slopes[i + 1];
  return slopes;
}

}  // namespace

CubicCurve::CubicCurve(std::span<const double> parameters, std::span<const Vec3> points_mm) {
  assert(parameters.size() == points_mm.size() && points_mm.size() >= 2);
  const std::vector<Vec3> slopes = natural_slopes(parameters, points_mm);
  knots_.resize(points_mm.size());
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    knots_[i].position_mm = points_mm[i].cast<float>();
    knots_[i].slope = slopes[i].cast<float>();
    const bool last = i + 1 == knots_.size();
    knots_[i].step = last ? 0.0F : static_cast<float>(parameters[i + 1] - parameters[i]);
  }
}

CurvePoint CubicCurve::at(double x) const {
  const double inside = std::clamp(x, 0.0, end());
  const std::size_t i = std::min(static_cast<std::size_t>(inside), knots_.size() - 2);
  const double w = inside - static_cast<double>(i);
  const Knot& a = knots_[i];
  const Knot& b = knots_[i + 1];
  const Vec3 p = a.position_mm.cast<double>();
  const Vec3 chord = b.position_mm.cast<double>() - p;
  const Vec3 slope_a = a.step * a.slope.cast<double>();
  const Vec3 slope_b = a.step * b.slope.cast<double>();
  // Hermite form in powers of w.
  const Vec3 c2 = 3.0 * chord - 2.0 * slope_a - slope_b;
  const Vec3 c3 = slope_a + slope_b - 2.0 * chord;
  return {p + w * (slope_a + w * (c2 + w * c3)), slope_a + w * (2.0 * c2 + 3.0 * w * c3)};
}

void CubicCurve::transform(const Isometry& T_a_b) {
  const Eigen::Matrix3d R_a_b = T_a_b.linear();
  for (Knot& knot : knots_) {
    knot.position_mm = (T_a_b * knot.position_mm.cast<double>()).cast<float>();
    knot.slope = (R_a_b * knot.slope.cast<double>()).cast<float>();
  }
}

}  // namespace flytri
