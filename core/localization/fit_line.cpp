#include "core/localization/fit_line.h"

#include <Eigen/Dense>
#include <cmath>

namespace flytri {
namespace {

/// Normal equations of one Gauss-Newton step for height, center and width.
struct Normal {
  Eigen::Matrix3f H = Eigen::Matrix3f::Zero();
  Eigen::Vector3f g = Eigen::Vector3f::Zero();
};

/// Sums over the window. The Gaussian runs along the row by its recurrence, two products a pixel.
std::optional<Normal> accumulate(const LineWindow& window, const NoiseModel& noise,
                                 const LineFit& fit) {
  const int first = static_cast<int>(std::ceil(fit.center_px - window.reach_px));
  const int last = static_cast<int>(std::floor(fit.center_px + window.reach_px));
  if (first < 0 || last >= static_cast<int>(window.row.size())) return std::nullopt;
  const float inverse = 1.0F / (fit.sigma_px * fit.sigma_px);
  float t = static_cast<float>(first) - fit.center_px;
  float shape = std::exp(-0.5F * t * t * inverse);
  float ratio = std::exp(-(t + 0.5F) * inverse);
  const float ratio_step = std::exp(-inverse);
  const float inverse_reach = 1.0F / window.reach_px;

  float haa = 0, hac = 0, haw = 0, hcc = 0, hcw = 0, hww = 0, ga = 0, gc = 0, gw = 0;
  for (int i = first; i <= last; ++i, t += 1.0F, shape *= ratio, ratio *= ratio_step) {
    const float value = window.row[static_cast<std::size_t>(i)];
    if (value >= window.full_scale) continue;
    const float signal = fit.amplitude * shape;
    const float residual = value - window.background.level - window.background.slope * t - signal;
    const float edge = t * inverse_reach;
    const float taper = 1.0F - edge * edge;
    const float weight = taper * taper / noise.variance(signal);
    const float by_center = signal * t * inverse;
    const float by_width = by_center * t / fit.sigma_px;
    haa += weight * shape * shape;
    hac += weight * shape * by_center;
    haw += weight * shape * by_width;
    hcc += weight * by_center * by_center;
    hcw += weight * by_center * by_width;
    hww += weight * by_width * by_width;
    ga += weight * shape * residual;
    gc += weight * by_center * residual;
    gw += weight * by_width * residual;
  }
  Normal normal;
  normal.H << haa, hac, haw, hac, hcc, hcw, haw, hcw, hww;
  normal.g << ga, gc, gw;
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
