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

/// Normal equations of one Gauss-Newton step for height (a), center (c) and width (w): sums of
/// weighted products of the derivatives, and of these with the residual (r).
struct Normal {
  float aa = 0, ac = 0, cc = 0, ar = 0, cr = 0;
  float aw = 0, cw = 0, ww = 0, wr = 0;  ///< zero where the width is not fitted
};

/// One step, and the variance of the center.
struct Step {
  float height = 0, center = 0, width = 0;
  float center_variance = 0;
};

/// 0, 1, 2, ...
Lanes lane_numbers() {
  Lanes numbers;
  numbers << 0, 1, 2, 3, 4, 5, 6, 7;
  return numbers;
}

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
template <bool kFitWidth>
std::optional<Normal> accumulate(const LineWindow& window, const NoiseModel& noise,
                                 const LineFit& fit) {
  const auto range = pixels_of(window, fit.center_px);
  if (!range) return std::nullopt;
  const float inverse_sigma = 1.0F / fit.sigma_px;
  const float sigma_over_reach = fit.sigma_px / window.reach_px;
  const float speckle = noise.speckle_contrast * noise.speckle_contrast;
  const Lanes zero = Lanes::Zero();
  Lanes aa = zero, ac = zero, cc = zero, ar = zero, cr = zero;
  Lanes aw = zero, cw = zero, ww = zero, wr = zero;
  Lanes pixel = lane_numbers() + (static_cast<float>(range->first) - fit.center_px);
  for (int i = 0; i < range->count; i += kLanes, pixel += static_cast<float>(kLanes)) {
    const Lanes value = Eigen::Map<const Lanes>(window.row.data() + range->first + i);
    const Lanes t = pixel * inverse_sigma;
    const Lanes shape = (-0.5F * t.square()).exp();
    const Lanes signal = fit.amplitude * shape;
    const Lanes residual =
        value - window.background.level - window.background.slope * pixel - signal;
    const Lanes taper = (1.0F - (t * sigma_over_reach).square()).max(0.0F);
    const Lanes variance = noise.read_variance + (noise.shot_gain + speckle * signal) * signal;
    const Lanes weight = (value < window.full_scale).select(taper.square() / variance, zero);
    const Lanes by_center = signal * t * inverse_sigma;
    const Lanes weighted_shape = weight * shape, weighted_center = weight * by_center;
    aa += weighted_shape * shape;
    ac += weighted_shape * by_center;
    cc += weighted_center * by_center;
    ar += weighted_shape * residual;
    cr += weighted_center * residual;
    if constexpr (kFitWidth) {
      const Lanes by_width = by_center * t, weighted_width = weight * by_width;
      aw += weighted_width * shape;
      cw += weighted_width * by_center;
      ww += weighted_width * by_width;
      wr += weighted_width * residual;
    }
  }
  return Normal{aa.sum(), ac.sum(), cc.sum(), ar.sum(), cr.sum(),
                aw.sum(), cw.sum(), ww.sum(), wr.sum()};
}

/// Share of the product of the diagonal below which the pixels do not determine the parameters.
constexpr float kSingular = 1e-4F;

std::optional<Step> solve_fixed_width(const Normal& n) {
  const float determinant = n.aa * n.cc - n.ac * n.ac;
  if (!(determinant > kSingular * n.aa * n.cc)) return std::nullopt;
  return Step{(n.cc * n.ar - n.ac * n.cr) / determinant, (n.aa * n.cr - n.ac * n.ar) / determinant,
              0.0F, n.aa / determinant};
}

std::optional<Step> solve_with_width(const Normal& n) {
  Eigen::Matrix3f H;
  H << n.aa, n.ac, n.aw, n.ac, n.cc, n.cw, n.aw, n.cw, n.ww;
  if (!(H.determinant() > kSingular * n.aa * n.cc * n.ww)) return std::nullopt;
  const Eigen::Matrix3f covariance = H.inverse();
  const Eigen::Vector3f step = covariance * Eigen::Vector3f(n.ar, n.cr, n.wr);
  return Step{step[0], step[1], step[2], covariance(1, 1)};
}

}  // namespace

std::optional<LineFit> fit_line(const LineWindow& window, const NoiseModel& noise,
                                const LineFit& start, bool fit_width, int iterations) {
  LineFit fit = start;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const auto normal =
        fit_width ? accumulate<true>(window, noise, fit) : accumulate<false>(window, noise, fit);
    if (!normal) return std::nullopt;
    const auto step = fit_width ? solve_with_width(*normal) : solve_fixed_width(*normal);
    // A step beyond the line's own size comes from something that is not this line.
    if (!step || !(std::abs(step->center) < fit.sigma_px) ||
        !(std::abs(step->width) < 0.5F * fit.sigma_px) ||
        !(std::abs(step->height) < 2.0F * fit.amplitude)) {
      return std::nullopt;
    }
    fit.amplitude = std::max(fit.amplitude + step->height, 0.2F * fit.amplitude);
    fit.center_px += step->center;
    fit.sigma_px += step->width;
    fit.center_variance = step->center_variance;
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
