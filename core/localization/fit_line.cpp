#include "core/localization/fit_line.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace flytri {
namespace {

/// Pixels that are computed side by side.
constexpr int kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

/// Normal equations of one Gauss-Newton step for height, center and width.
struct Normal {
  Eigen::Matrix3f H = Eigen::Matrix3f::Zero();
  Eigen::Vector3f g = Eigen::Vector3f::Zero();
};

/// First pixel and number of pixels, a multiple of the lanes, that hold the window.
struct PixelRange {
  int first = 0;
  int count = 0;
};

std::optional<PixelRange> pixels_of(const LineWindow& window, float center) {
  const int size = static_cast<int>(window.row.size());
  const int first = static_cast<int>(std::ceil(center - window.reach_px));
  const int last = static_cast<int>(std::floor(center + window.reach_px));
  if (first < 0 || last >= size) return std::nullopt;
  const int count = (last - first) / kLanes * kLanes + kLanes;
  if (count > size) return std::nullopt;
  return PixelRange{std::min(first, size - count), count};
}

/// Sums over the window. Pixels beyond its reach have no weight.
std::optional<Normal> accumulate(const LineWindow& window, const NoiseModel& noise,
                                 const LineFit& fit) {
  const auto range = pixels_of(window, fit.center_px);
  if (!range) return std::nullopt;
  const float inverse_sigma = 1.0F / fit.sigma_px;
  const float sigma_over_reach = fit.sigma_px / window.reach_px;
  const float speckle = noise.speckle_contrast * noise.speckle_contrast;
  std::array<Lanes, 9> sums;
  for (Lanes& sum : sums) sum.setZero();
  Lanes pixel =
      Lanes::LinSpaced(0.0F, kLanes - 1.0F) + (static_cast<float>(range->first) - fit.center_px);
  for (int i = 0; i < range->count; i += kLanes, pixel += static_cast<float>(kLanes)) {
    const Lanes value = Eigen::Map<const Lanes>(window.row.data() + range->first + i);
    const Lanes t = pixel * inverse_sigma;
    const Lanes shape = (-0.5F * t.square()).exp();
    const Lanes signal = fit.amplitude * shape;
    const Lanes residual =
        value - window.background.level - window.background.slope * pixel - signal;
    const Lanes taper = (1.0F - (t * sigma_over_reach).square()).max(0.0F);
    const Lanes variance = noise.read_variance + (noise.shot_gain + speckle * signal) * signal;
    const Lanes weight =
        (value < window.full_scale).select(taper.square() / variance, Lanes::Zero());
    const Lanes by_center = signal * t * inverse_sigma;
    const Lanes by_width = by_center * t;
    const Lanes weighted_shape = weight * shape, weighted_center = weight * by_center,
                weighted_width = weight * by_width;
    sums[0] += weighted_shape * shape;
    sums[1] += weighted_shape * by_center;
    sums[2] += weighted_shape * by_width;
    sums[3] += weighted_center * by_center;
    sums[4] += weighted_center * by_width;
    sums[5] += weighted_width * by_width;
    sums[6] += weighted_shape * residual;
    sums[7] += weighted_center * residual;
    sums[8] += weighted_width * residual;
  }
  std::array<float, 9> s{};
  for (std::size_t k = 0; k < s.size(); ++k) s[k] = sums[k].sum();
  Normal normal;
  normal.H << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  normal.g << s[6], s[7], s[8];
  return normal;
}

}  // namespace

std::optional<LineFit> fit_line(const LineWindow& window, const NoiseModel& noise,
                                const LineFit& start, bool fit_width, int iterations) {
  LineFit fit = start;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    auto normal = accumulate(window, noise, fit);
    if (!normal) return std::nullopt;
    if (!fit_width) {
      normal->H.row(2) << 0, 0, 1;
      normal->H.col(2) << 0, 0, 1;
      normal->g[2] = 0;
    }
    const float scale = normal->H(0, 0) * normal->H(1, 1) * normal->H(2, 2);
    if (!(normal->H.determinant() > 1e-4F * scale)) return std::nullopt;
    const Eigen::Matrix3f covariance = normal->H.inverse();
    const Eigen::Vector3f step = covariance * normal->g;
    // A step beyond the line's own size comes from something that is not this line.
    if (!(std::abs(step[1]) < fit.sigma_px) || !(std::abs(step[2]) < 0.5F * fit.sigma_px) ||
        !(std::abs(step[0]) < 2.0F * fit.amplitude)) {
      return std::nullopt;
    }
    fit.amplitude = std::max(fit.amplitude + step[0], 0.2F * fit.amplitude);
    fit.center_px += step[1];
    fit.sigma_px += step[2];
    fit.center_variance = covariance(1, 1);
  }
  return fit;
}

std::optional<FlankLevel> flank_level(std::span<const float> row, const LineFit& line) {
  constexpr int kCount = 4;                     // pixels a side
  const float distance = 3.5F * line.sigma_px;  // a Gaussian is down to 0.2 % there
  const int left = static_cast<int>(std::floor(line.center_px - distance)) - kCount + 1;
  const int right = static_cast<int>(std::ceil(line.center_px + distance));
  if (left < 0 || right + kCount > static_cast<int>(row.size())) return std::nullopt;
  float left_sum = 0, right_sum = 0;
  for (int k = 0; k < kCount; ++k) {
    left_sum += row[static_cast<std::size_t>(left + k)];
    right_sum += row[static_cast<std::size_t>(right + k)];
  }
  const float left_mean = left_sum / kCount, right_mean = right_sum / kCount;
  if (std::abs(left_mean - right_mean) > 0.1F * line.amplitude) {
    return FlankLevel{std::min(left_mean, right_mean), 0.0F};
  }
  const float left_center = static_cast<float>(left) + 0.5F * (kCount - 1);
  const float right_center = static_cast<float>(right) + 0.5F * (kCount - 1);
  const float slope = (right_mean - left_mean) / (right_center - left_center);
  return FlankLevel{left_mean + slope * (line.center_px - left_center), slope};
}

}  // namespace flytri
