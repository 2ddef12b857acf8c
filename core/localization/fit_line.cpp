#include "core/localization/fit_line.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace flytri::localization {
namespace {

/// Pixels computed together.
constexpr int kFitLanes = 8;
using FitLanes = Eigen::Array<float, kFitLanes, 1>;

/// Weighted moments of the pixels: sums of w g² t^k and of w y g t^k. g is the Gaussian shape of
/// the line, t the distance from its center in sigmas, y the light above the background, w the
/// weight.
struct Moments {
  std::array<float, 5> shape{};  ///< k = 3, 4 are zero if the width is not fitted
  std::array<float, 3> light{};  ///< k = 2 is zero if the width is not fitted
};

/// The solution for y = height · (g + shift · g t + widening · g t²), a first-order model with
/// shift and widening in sigmas.
struct Solution {
  float height = 0, shift = 0, widening = 0;
  float shift_variance = 0;
};

/// 0, 1, 2, ...
FitLanes lane_numbers() {
  FitLanes numbers;
  numbers << 0, 1, 2, 3, 4, 5, 6, 7;
  return numbers;
}

/// The pixels of the window. Their number is a multiple of kFitLanes.
struct PixelRange {
  int first = 0;
  int count = 0;
};

std::optional<PixelRange> pixels_of(const LineWindow& window, float center) {
  const int size = static_cast<int>(window.row.size());
  const int first = static_cast<int>(std::ceil(center - window.reach_px));
  const int last = static_cast<int>(std::floor(center + window.reach_px));
  if (first < 0 || last >= size) return std::nullopt;
  const int count = (last - first) / kFitLanes * kFitLanes + kFitLanes;
  if (count > size) return std::nullopt;
  return PixelRange{std::min(first, size - count), count};
}

/// Sums over the window. Pixels beyond `reach_px` have weight zero.
template <bool kFitWidth>
std::optional<Moments> accumulate(const LineWindow& window, const NoiseModel& noise,
                                  const LineFit& fit) {
  const auto range = pixels_of(window, fit.center_px);
  if (!range) return std::nullopt;
  const float inverse_sigma = 1.0F / fit.sigma_px;
  const float sigma_over_reach = fit.sigma_px / window.reach_px;
  const float speckle = noise.speckle_contrast * noise.speckle_contrast;
  const FitLanes zero = FitLanes::Zero();
  FitLanes s0 = zero, s1 = zero, s2 = zero, s3 = zero, s4 = zero, y0 = zero, y1 = zero, y2 = zero;
  FitLanes pixel = lane_numbers() + (static_cast<float>(range->first) - fit.center_px);
  for (int i = 0; i < range->count; i += kFitLanes, pixel += static_cast<float>(kFitLanes)) {
    const FitLanes value = Eigen::Map<const FitLanes>(window.row.data() + range->first + i);
    const FitLanes t = pixel * inverse_sigma;
    const FitLanes shape = (-0.5F * t.square()).exp();
    const FitLanes signal = fit.amplitude * shape;
    const FitLanes taper = (1.0F - (t * sigma_over_reach).square()).max(0.0F);
    const FitLanes variance = noise.read_variance + (noise.shot_gain + speckle * signal) * signal;
    // 1 below full scale, 0 at full scale: gray values are integers.
    const FitLanes unclipped = (window.full_scale - value).min(1.0F).max(0.0F);
    const FitLanes weight = unclipped * taper.square() / variance;
    const FitLanes light = value - window.background.level - window.background.slope * pixel;
    const FitLanes weighted = weight * shape;
    const FitLanes w0 = weighted * shape, w1 = w0 * t, w2 = w1 * t;
    const FitLanes l0 = weighted * light, l1 = l0 * t;
    s0 += w0, s1 += w1, s2 += w2;
    y0 += l0, y1 += l1;
    if constexpr (kFitWidth) {
      const FitLanes w3 = w2 * t;
      s3 += w3, s4 += w3 * t;
      y2 += l1 * t;
    }
  }
  return Moments{{s0.sum(), s1.sum(), s2.sum(), s3.sum(), s4.sum()},
                 {y0.sum(), y1.sum(), y2.sum()}};
}

/// If the determinant is below this share of the product of the diagonal, the pixels do not
/// determine the parameters.
constexpr float kSingular = 1e-4F;

std::optional<Solution> solve_fixed_width(const Moments& m) {
  const auto& s = m.shape;
  const float determinant = s[0] * s[2] - s[1] * s[1];
  if (!(determinant > kSingular * s[0] * s[2])) return std::nullopt;
  const float height = (s[2] * m.light[0] - s[1] * m.light[1]) / determinant;
  const float shift = (s[0] * m.light[1] - s[1] * m.light[0]) / (determinant * height);
  return Solution{height, shift, 0.0F, s[0] / (determinant * height * height)};
}

std::optional<Solution> solve_with_width(const Moments& m) {
  const auto& s = m.shape;
  Eigen::Matrix3f H;
  H << s[0], s[1], s[2], s[1], s[2], s[3], s[2], s[3], s[4];
  if (!(H.determinant() > kSingular * s[0] * s[2] * s[4])) return std::nullopt;
  const Eigen::Matrix3f covariance = H.inverse();
  const Eigen::Vector3f x = covariance * Eigen::Vector3f(m.light[0], m.light[1], m.light[2]);
  return Solution{x[0], x[1] / x[0], x[2] / x[0], covariance(1, 1) / (x[0] * x[0])};
}

/// A step larger than the line itself means that the pixels show something else.
bool is_of_this_line(const Solution& solution, const LineFit& fit) {
  return std::abs(solution.shift) < 1.0F && std::abs(solution.widening) < 0.5F &&
         solution.height > 0.2F * fit.amplitude && solution.height < 3.0F * fit.amplitude;
}

/// The remaining error is of third order: a thousandth of a sigma after such a small step.
bool is_settled(const Solution& solution, const LineFit& before) {
  return std::abs(solution.shift) < 0.15F && std::abs(solution.widening) < 0.1F &&
         std::abs(solution.height - before.amplitude) < 0.3F * before.amplitude;
}

float mean(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0F) / static_cast<float>(values.size());
}

}  // namespace

std::optional<LineFit> fit_line(const LineWindow& window, const NoiseModel& noise,
                                const LineFit& start, bool fit_width, int max_steps) {
  LineFit fit = start;
  for (int step = 0; step < max_steps; ++step) {
    const auto moments =
        fit_width ? accumulate<true>(window, noise, fit) : accumulate<false>(window, noise, fit);
    if (!moments) return std::nullopt;
    const auto solution = fit_width ? solve_with_width(*moments) : solve_fixed_width(*moments);
    if (!solution || !is_of_this_line(*solution, fit)) return std::nullopt;
    const bool settled = is_settled(*solution, fit);
    fit.center_variance = solution->shift_variance * fit.sigma_px * fit.sigma_px;
    fit.amplitude = solution->height;
    fit.center_px += solution->shift * fit.sigma_px;
    fit.sigma_px += solution->widening * fit.sigma_px;
    if (settled) break;
  }
  return fit;
}

std::optional<FlankLevel> flank_level(std::span<const float> row, const LineFit& line) {
  constexpr int kCount = 4;                     // pixels on each side
  const float distance = 3.5F * line.sigma_px;  // a Gaussian is down to 0.2 % there
  const int left = static_cast<int>(std::floor(line.center_px - distance)) - kCount + 1;
  const int right = static_cast<int>(std::ceil(line.center_px + distance));
  if (left < 0 || right + kCount > static_cast<int>(row.size())) return std::nullopt;
  const float left_mean = mean(row.subspan(static_cast<std::size_t>(left), kCount));
  const float right_mean = mean(row.subspan(static_cast<std::size_t>(right), kCount));
  if (std::abs(left_mean - right_mean) > 0.1F * line.amplitude) {
    return FlankLevel{std::min(left_mean, right_mean), 0.0F};
  }
  const float left_center = static_cast<float>(left) + 0.5F * (kCount - 1);
  const float right_center = static_cast<float>(right) + 0.5F * (kCount - 1);
  const float slope = (right_mean - left_mean) / (right_center - left_center);
  return FlankLevel{left_mean + slope * (line.center_px - left_center), slope};
}

}  // namespace flytri::localization
