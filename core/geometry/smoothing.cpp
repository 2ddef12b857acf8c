#include "core/geometry/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/check_options.h"
#include "core/base/median.h"

namespace flytri {
namespace {

/// A Gaussian narrower than this has no weight on neighbors.
constexpr double kNoSmoothing = 0.4;
/// End of the window, where the weight is 4 %.
constexpr double kWindowSigmas = 2.5;

/// Gaussian weights by distance in sigmas, from a table: exp() would dominate the smoothing.
class GaussianTable {
 public:
  GaussianTable() {
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const double x = static_cast<double>(i) / kPerSigma;
      weights_[i] = std::exp(-0.5 * x * x);
    }
  }
  /// @param x  distance in sigmas, 0..kWindowSigmas.
  [[nodiscard]] double operator()(double x) const {
    const double place = x * kPerSigma;
    const auto i = std::min(static_cast<std::size_t>(place), weights_.size() - 2);
    return weights_[i] + (place - static_cast<double>(i)) * (weights_[i + 1] - weights_[i]);
  }

 private:
  static constexpr double kPerSigma = 32.0;
  std::array<double, 3 * 32 + 2> weights_{};
};

/// Weighted moments of the points around one place: sums of w t^i, and of w t^i p.
struct Moments {
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0;
  Vec3 p0 = Vec3::Zero(), p1 = Vec3::Zero(), p2 = Vec3::Zero();
  double low_t = 0, high_t = 0;  ///< extent of the window to both sides, in sigmas
};

/// Sums of the moments. (p, 1) fills a register of four, so the sums of w t^i need no extra work.
struct MomentSums {
  Eigen::Vector4d by_t0 = Eigen::Vector4d::Zero();
  Eigen::Vector4d by_t1 = Eigen::Vector4d::Zero();
  Eigen::Vector4d by_t2 = Eigen::Vector4d::Zero();
  double s3 = 0, s4 = 0;

  void add(double w, double t, const Vec3& p) {
    const Eigen::Vector4d q(p.x(), p.y(), p.z(), 1.0);
    const double wt = w * t, wtt = wt * t;
    by_t0 += w * q, by_t1 += wt * q, by_t2 += wtt * q;
    s3 += wtt * t, s4 += wtt * t * t;
  }
};

/// @param stride  uses every stride-th point, starting at the center
Moments gather(std::span<const ProfilePoint> points, std::size_t center, double sigma_px,
               std::size_t stride = 1) {
  static const GaussianTable gaussian;
  const double along = points[center].along_px;
  const double per_px = 1.0 / sigma_px;
  MomentSums sums;
  Moments m;
  const auto add = [&](std::size_t i) {
    const double t = (points[i].along_px - along) * per_px;
    if (std::abs(t) > kWindowSigmas) return false;
    const double w = gaussian(std::abs(t));
    sums.add(w, t, points[i].position_mm - points[center].position_mm);
    m.low_t = std::min(m.low_t, t), m.high_t = std::max(m.high_t, t);
    return true;
  };
  for (std::size_t i = center; i >= stride && add(i - stride); i -= stride) {
  }
  for (std::size_t i = center; i < points.size() && add(i); i += stride) {
  }
  m.s0 = sums.by_t0[3], m.s1 = sums.by_t1[3], m.s2 = sums.by_t2[3], m.s3 = sums.s3, m.s4 = sums.s4;
  m.p0 = sums.by_t0.head<3>(), m.p1 = sums.by_t1.head<3>(), m.p2 = sums.by_t2.head<3>();
  return m;
}

/// Value at t = 0 relative to the center point, and the share of the noise that remains.
struct Value {
  Vec3 offset_mm;
  double noise_gain;
};

/// Local line: exact for straight profiles, also in one-sided windows.
Value linear_value(const Moments& m) {
  const double det = m.s0 * m.s2 - m.s1 * m.s1;
  if (det <= 1e-9 * m.s0 * m.s0) return {Vec3::Zero(), 1.0};
  return {(m.s2 * m.p0 - m.s1 * m.p1) / det, m.s2 / det};
}

/// Local parabola for windows with points on both sides.
Value quadratic_value(const Moments& m) {
  Eigen::Matrix3d S;
  S << m.s0, m.s1, m.s2, m.s1, m.s2, m.s3, m.s2, m.s3, m.s4;
  const double det = S.determinant();
  if (det <= 1e-9 * m.s0 * m.s0 * m.s0) return linear_value(m);
  const Vec3 row =
      Vec3(m.s2 * m.s4 - m.s3 * m.s3, m.s2 * m.s3 - m.s1 * m.s4, m.s1 * m.s3 - m.s2 * m.s2) / det;
  return {row[0] * m.p0 + row[1] * m.p1 + row[2] * m.p2, row[0]};
}

/// Slope of the local line with respect to t.
Vec3 linear_slope(const Moments& m) {
  return (m.s0 * m.p1 - m.s1 * m.p0) / std::max(m.s0 * m.s2 - m.s1 * m.s1, 1e-12);
}

/// Pixels along the line from one point to the next.
double spacing_px(std::span<const ProfilePoint> points) {
  const double span_px = points.back().along_px - points.front().along_px;
  return span_px / static_cast<double>(points.size() - 1);
}

SmoothedPoint smooth_point(std::span<const ProfilePoint> points, std::size_t i, double sigma_px) {
  SmoothedPoint result;
  result.along_px = points[i].along_px;
  result.position_mm = points[i].position_mm;
  double gain = 1.0;
  if (sigma_px >= kNoSmoothing * spacing_px(points)) {
    const Moments m = gather(points, i, sigma_px);
    const bool inside = std::min(-m.low_t, m.high_t) > 0.5 * kWindowSigmas;
    const Value value = inside ? quadratic_value(m) : linear_value(m);
    result.position_mm += value.offset_mm;
    // The value's weights are w (c0 + c1 t + c2 t²); for Gaussian weights, the sum of their squares
    // is about 1/sqrt(2) of the weight of the center.
    gain = std::sqrt(std::min(1.0, value.noise_gain * std::numbers::sqrt2 / 2.0));
  }
  result.deviation_mm = gain * points[i].deviation_mm.cast<double>();
  const double wide_px = std::max(2.0 * sigma_px, spacing_px(points));
  // In a wide window, a few points per sigma give the same direction as all points.
  const auto stride = static_cast<std::size_t>(std::max(1.0, wide_px / spacing_px(points) / 4.0));
  result.direction = linear_slope(gather(points, i, wide_px, stride)).normalized();
  return result;
}

}  // namespace

Result<void> SmoothingOptions::validate() const {
  return OptionCheck("SmoothingOptions")
      .positive_up_to("max_direction_noise_rad", max_direction_noise_rad, 1.0)
      .in_range("max_sigma_samples", max_sigma_samples, 0.5, 100.0)
      .result();
}

double smoothing_sigma(std::span<const ProfilePoint> points, const SmoothingOptions& options) {
  // Second differences over three samples. Speckle is correlated between neighbors, so closer
  // samples would show too little of it.
  constexpr std::size_t kLag = 3;
  if (points.size() < 2 * kLag + 2) return 0.0;
  std::vector<double> stated, bends, steps;
  for (std::size_t i = kLag; i + kLag < points.size(); ++i) {
    const Vec3& p = points[i].position_mm;
    const Vec3& before = points[i - kLag].position_mm;
    const Vec3& after = points[i + kLag].position_mm;
    stated.push_back(points[i].deviation_mm.norm());
    steps.push_back((after - before).norm() / (2.0 * kLag));
    bends.push_back((after + before - 2.0 * p).norm());
  }
  // White noise of 1 gives second differences of sqrt(6).
  const double shown_mm = median_of(bends) / (kMedianOfSigma * std::sqrt(6.0));
  const double noise_mm = std::clamp(median_of(stated), shown_mm, 2.0 * shown_mm);
  const double ratio = noise_mm / std::max(median_of(steps), 1e-9);
  // Slope of a Gaussian-weighted line fit over sigma samples: variance = ratio² / (4 sqrt(pi)
  // sigma³).
  const double slope = options.max_direction_noise_rad;
  const double sigma =
      std::cbrt(ratio * ratio / (4.0 * std::sqrt(std::numbers::pi) * slope * slope));
  return std::min(sigma, options.max_sigma_samples);
}

std::vector<SmoothedPoint> smooth_profile(std::span<const ProfilePoint> points,
                                          double sigma_samples) {
  const double sigma_px = sigma_samples * spacing_px(points);
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::round(sigma_samples)));
  std::vector<SmoothedPoint> result;
  result.reserve(points.size() / stride + 2);
  const std::size_t last = points.size() - 1;
  for (std::size_t i = 0; i < last; i += stride) {
    result.push_back(smooth_point(points, i, sigma_px));
  }
  result.push_back(smooth_point(points, last, sigma_px));
  return result;
}

}  // namespace flytri
