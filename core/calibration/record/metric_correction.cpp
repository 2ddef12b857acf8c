#include "core/calibration/record/metric_correction.h"

namespace flytri::calibration {
namespace {

/// Places of the terms in TrivariateCubic::kExponents.
constexpr std::size_t kConstant = 0, kLinear = 1;

/// f(u, v, z) becomes scale * f(u, v, z / depth) + shear * z.
TrivariateCubic corrected_lateral(TrivariateCubic f, double scale, double depth, double shear) {
  f.center.z() *= depth;
  f.half_range.z() *= depth;
  for (double& coefficient : f.coefficients) coefficient *= scale;
  f.coefficients[kConstant] += shear * f.center.z();
  f.coefficients[kLinear + 2] += shear * f.half_range.z();
  f.residual.rms *= scale;
  f.residual.max *= scale;
  return f;
}

double power(double x, int exponent) {
  double result = 1.0;
  for (int i = 0; i < exponent; ++i) result *= x;
  return result;
}

/// The cubic that gives f(map * p) at p.
TrivariateCubic substituted(const TrivariateCubic& f, const Eigen::Matrix3d& map) {
  // As many values as a cubic has terms determine it, if they lie on a grid of this shape.
  using Matrix = Eigen::Matrix<double, TrivariateCubic::kTerms, TrivariateCubic::kTerms>;
  Matrix terms;
  Eigen::Matrix<double, TrivariateCubic::kTerms, 1> values;
  for (int row = 0; row < TrivariateCubic::kTerms; ++row) {
    const auto& place = TrivariateCubic::kExponents[static_cast<std::size_t>(row)];
    const Vec3 t = Vec3(place[0], place[1], place[2]) * (2.0 / 3.0) - Vec3::Constant(1.0 / 3.0);
    values[row] = f(map * (f.center + t.cwiseProduct(f.half_range)));
    for (int term = 0; term < TrivariateCubic::kTerms; ++term) {
      const auto& exponents = TrivariateCubic::kExponents[static_cast<std::size_t>(term)];
      terms(row, term) =
          power(t.x(), exponents[0]) * power(t.y(), exponents[1]) * power(t.z(), exponents[2]);
    }
  }
  const Eigen::Matrix<double, TrivariateCubic::kTerms, 1> coefficients =
      terms.partialPivLu().solve(values);
  TrivariateCubic result = f;
  std::copy(coefficients.begin(), coefficients.end(), result.coefficients.begin());
  return result;
}

void correct_depths(PatternCalibration& pattern, double depth, const Eigen::Matrix3d& inverse) {
  for (std::vector<LineRow>& line : pattern.lines) {
    for (LineRow& row : line) {
      for (double& coefficient : row.depth_mm.coefficients) coefficient *= depth;
    }
  }
  for (Vec3& normal : pattern.sheet_normals) normal = (inverse.transpose() * normal).normalized();
  pattern.depth_residual_mm.rms *= depth;
  pattern.depth_residual_mm.max *= depth;
}

}  // namespace

Eigen::Matrix3d MetricCorrection::matrix() const {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix.diagonal() << lateral, lateral, depth;
  matrix.topRightCorner<2, 1>() = shear;
  return matrix;
}

Calibration corrected(const Calibration& calibration, const MetricCorrection& correction) {
  const Eigen::Matrix3d map = correction.matrix();
  const Eigen::Matrix3d inverse = map.inverse();
  Calibration result = calibration;
  // x = lateral * x(z) + shear * z, with the old z; the new one is depth times as large.
  const Eigen::Vector2d shear = correction.shear / correction.depth;
  result.x_mm =
      corrected_lateral(calibration.x_mm, correction.lateral, correction.depth, shear.x());
  result.y_mm =
      corrected_lateral(calibration.y_mm, correction.lateral, correction.depth, shear.y());
  for (PatternCalibration& pattern : result.patterns)
    correct_depths(pattern, correction.depth, inverse);
  result.texture_u_px = substituted(calibration.texture_u_px, inverse);
  result.texture_v_px = substituted(calibration.texture_v_px, inverse);
  if (result.flash) result.flash->p_sensor_mm = map * calibration.flash->p_sensor_mm;
  return result;
}

}  // namespace flytri::calibration
