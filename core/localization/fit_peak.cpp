#include "core/localization/fit_peak.h"

#include <algorithm>
#include <cmath>

namespace flytri {
namespace {

constexpr float kReach = 3.0F;  // a Gaussian is cut at three standard deviations

/// Value of the smoothed row at `column`, above the background.
float smoothed(std::span<const float> row, int column, std::span<const float> half,
               float background) {
  const float* at = row.data() + column;
  float sum = half[0] * (at[0] - background);
  for (int k = 1; k < static_cast<int>(half.size()); ++k) {
    sum += half[k] * (at[k] + at[-k] - 2.0F * background);
  }
  return sum;
}

/// Position, width and height of the Gaussian through three neighboring values.
std::optional<PeakFit> three_points(float left, float middle, float right) {
  if (!(left > 0 && middle > 0 && right > 0)) return std::nullopt;
  const float a = std::log(left), b = std::log(middle), c = std::log(right);
  const float curvature = 2.0F * b - a - c;
  if (!(curvature > 0)) return std::nullopt;
  const float offset = 0.5F * (c - a) / curvature;
  if (std::abs(offset) > 1.0F) return std::nullopt;
  return PeakFit{offset, 1.0F / std::sqrt(curvature),
                 middle * std::exp(0.5F * offset * offset * curvature)};
}

/// Three-point fit after smoothing; the width and height are those before smoothing.
std::optional<PeakFit> smoothed_fit(std::span<const float> row, int column, float background,
                                    std::span<const float> half, float sigma) {
  const int reach = static_cast<int>(half.size());
  if (column < reach || column + reach >= static_cast<int>(row.size())) return std::nullopt;
  auto fit = three_points(smoothed(row, column - 1, half, background),
                          smoothed(row, column, half, background),
                          smoothed(row, column + 1, half, background));
  if (!fit) return fit;
  const float variance = fit->sigma_px * fit->sigma_px - sigma * sigma;
  if (!(variance > 0.01F)) return std::nullopt;  // narrower than a pixel: not an imaged line
  const float total = fit->sigma_px;
  fit->sigma_px = std::sqrt(variance);
  fit->amplitude *= total / fit->sigma_px;
  fit->center_px += static_cast<float>(column);
  return fit;
}

}  // namespace

GaussianKernels::GaussianKernels() {
  for (int i = 0; i < kCount; ++i) {
    const float sigma = kStep * static_cast<float>(i + 1);
    const int radius = static_cast<int>(std::ceil(kReach * sigma));
    std::vector<float>& half = halves_[static_cast<std::size_t>(i)];
    float sum = 0;
    for (int k = 0; k <= radius; ++k) {
      half.push_back(std::exp(-0.5F * static_cast<float>(k * k) / (sigma * sigma)));
      sum += k == 0 ? half.back() : 2.0F * half.back();
    }
    for (float& weight : half) weight /= sum;
  }
}

int GaussianKernels::index(float sigma_px) {
  return std::clamp(static_cast<int>(std::lround(sigma_px / kStep)) - 1, 0, kCount - 1);
}

std::span<const float> GaussianKernels::half(float sigma_px) const {
  return halves_[static_cast<std::size_t>(index(sigma_px))];
}

float GaussianKernels::sigma_px(float sigma_px) const {
  return kStep * static_cast<float>(index(sigma_px) + 1);
}

std::optional<PeakFit> fit_peak(std::span<const float> row, int column, float background,
                                const GaussianKernels& kernels, float first_sigma_px) {
  const auto first = smoothed_fit(row, column, background, kernels.half(first_sigma_px),
                                  kernels.sigma_px(first_sigma_px));
  if (!first) return std::nullopt;
  const float own = first->sigma_px;
  const auto matched = smoothed_fit(row, static_cast<int>(std::lround(first->center_px)),
                                    background, kernels.half(own), kernels.sigma_px(own));
  return matched;
}

}  // namespace flytri
