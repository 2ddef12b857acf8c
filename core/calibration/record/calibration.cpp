#include "core/calibration/record/calibration.h"

#include <cassert>
#include <cmath>

#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

constexpr std::array<std::array<int, 3>, TrivariateCubic::kTerms> make_exponents() {
  std::array<std::array<int, 3>, TrivariateCubic::kTerms> exponents{};
  int next = 0;
  for (int degree = 0; degree <= 3; ++degree) {
    for (int i = degree; i >= 0; --i) {
      for (int j = degree - i; j >= 0; --j) exponents[next++] = {i, j, degree - i - j};
    }
  }
  return exponents;
}

}  // namespace

const std::array<std::array<int, 3>, TrivariateCubic::kTerms> TrivariateCubic::kExponents =
    make_exponents();

double TrivariateCubic::operator()(const Vec3& p) const {
  const Vec3 t = (p - center).cwiseQuotient(half_range);
  const double x = t[0], y = t[1], z = t[2];
  const auto& c = coefficients;  // in the order of kExponents, nested to save products
  const double by_x = c[1] + x * (c[4] + x * c[10] + y * c[11] + z * c[12]) +
                      y * (c[5] + y * c[13] + z * c[14]) + z * (c[6] + z * c[15]);
  const double by_y = c[2] + y * (c[7] + y * c[16] + z * c[17]) + z * (c[8] + z * c[18]);
  const double by_z = c[3] + z * (c[9] + z * c[19]);
  return c[0] + x * by_x + y * by_y + z * by_z;
}

Vec3 TrivariateCubic::gradient(const Vec3& p) const {
  const Vec3 t = (p - center).cwiseQuotient(half_range);
  const double x = t[0], y = t[1], z = t[2];
  const auto& c = coefficients;  // as above
  const double by_x = c[1] + x * (2 * c[4] + 3 * x * c[10] + 2 * (y * c[11] + z * c[12])) +
                      y * (c[5] + y * c[13] + z * c[14]) + z * (c[6] + z * c[15]);
  const double by_y = c[2] + x * (c[5] + x * c[11] + 2 * y * c[13] + z * c[14]) +
                      y * (2 * c[7] + 3 * y * c[16] + 2 * z * c[17]) + z * (c[8] + z * c[18]);
  const double by_z = c[3] + x * (c[6] + x * c[12] + y * c[14] + 2 * z * c[15]) +
                      y * (c[8] + y * c[17] + 2 * z * c[18]) + z * (2 * c[9] + 3 * z * c[19]);
  return Vec3(by_x, by_y, by_z).cwiseQuotient(half_range);
}

bool PatternCalibration::has_shared_areas() const {
  constexpr std::size_t kAlongStep = 32;  // dense lines share areas in all rows
  for (std::size_t n = 0; n + 1 < lines.size(); ++n) {
    for (std::size_t along = 0; along < lines[n].size(); along += kAlongStep) {
      const LineRow &left = lines[n][along], &right = lines[n + 1][along];
      if (left.valid() && right.valid() && left.area_max_px >= right.area_min_px) return true;
    }
  }
  return false;
}

Vec3 Calibration::locate(Pattern pattern, LineIndex n, const LinePixel& pixel) const {
  const auto& rows = of(pattern).lines[n.at()];
  const LineRow& row = rows[static_cast<std::size_t>(std::lround(pixel.along_px))];
  assert(row.valid());
  const double z = row.depth_mm(pixel.across_px);
  const Pixel at = to_pixel(pattern, pixel);
  const Vec3 uvz(at.u_px, at.v_px, z);
  return {x_mm(uvz), y_mm(uvz), z};
}

std::optional<Vec3> Calibration::camera_center_mm() const {
  // The point nearest to the rays of a grid of pixels.
  constexpr int kSteps = 9;
  constexpr double kLeastShare = 1e-6;
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Vec3 uvz(measurement_size.width_px * (i + 0.5) / kSteps,
                     measurement_size.height_px * (j + 0.5) / kSteps, 0.0);
      const Vec3 p(x_mm(uvz), y_mm(uvz), 0.0);
      if (!volume.contains(p)) continue;
      const Vec3 ray = Vec3(x_mm.gradient(uvz).z(), y_mm.gradient(uvz).z(), 1.0).normalized();
      const Eigen::Matrix3d beside = Eigen::Matrix3d::Identity() - ray * ray.transpose();
      across += beside;
      right += beside * p;
    }
  }
  const auto eigen = symmetric_eigen(across);
  if (!(eigen.values[0] > kLeastShare * eigen.values[2])) return std::nullopt;
  return eigen.vectors * (eigen.vectors.transpose() * right).cwiseQuotient(eigen.values);
}

Pixel Calibration::project_to_measurement(const Vec3& p_sensor) const {
  // Newton's method. The polynomials are nearly linear in u and v.
  constexpr int kSteps = 4;
  Vec3 uvz(0.5 * measurement_size.width_px, 0.5 * measurement_size.height_px, p_sensor.z());
  for (int i = 0; i < kSteps; ++i) {
    Eigen::Matrix2d J;
    J << x_mm.gradient(uvz).head<2>().transpose(), y_mm.gradient(uvz).head<2>().transpose();
    const double determinant = J.determinant();
    if (determinant == 0.0) break;
    const Vec2 off(x_mm(uvz) - p_sensor.x(), y_mm(uvz) - p_sensor.y());
    uvz.head<2>() -=
        Vec2(J(1, 1) * off[0] - J(0, 1) * off[1], J(0, 0) * off[1] - J(1, 0) * off[0]) /
        determinant;
  }
  return {uvz[0], uvz[1]};
}

Pixel Calibration::project_to_texture(const Vec3& p_sensor) const {
  return {texture_u_px(p_sensor), texture_v_px(p_sensor)};
}

}  // namespace flytri::calibration
