/// @file  Weighted fit of a Gaussian above a linear background to one line cross-section.
#pragma once

#include <optional>
#include <span>

#include "core/localization/noise_model.h"

namespace flytri::localization {

/// A Gaussian line in one row.
struct LineFit {
  float center_px = 0;
  float sigma_px = 0;
  float amplitude = 0;
  float center_variance = 0;  ///< px^2, from the noise model
};

/// Background under a line: `level` at its center, rising by `slope` per px.
struct FlankLevel {
  float level = 0;
  float slope = 0;
};

/// Input of a fit.
struct LineWindow {
  std::span<const float> row;
  FlankLevel background;
  float reach_px = 0;         ///< pixels farther from the start's center are ignored
  float full_scale = 255.0F;  ///< pixels at or above it are clipped and ignored
};

/// Improves `start` by at most `max_steps` Gauss-Newton steps, fewer if a step is small. The weight
/// of a pixel is the inverse of its variance, and decreases to zero at the ends of the window, so
/// that the result changes continuously.
///
/// Under speckle the flanks determine the position best, because the relative change of light is
/// largest there. The three points at the top contribute little.
/// @source  this project's. It replaces the three-point interpolation of Arold et al., "Line
///          Localization"; tests/unit/localization/localize_test.cpp measures the gain.
/// @param fit_width  false: the width stays fixed.
/// @return nullopt if the window extends beyond the row or the pixels do not determine the line.
[[nodiscard]] std::optional<LineFit> fit_line(const LineWindow& window, const NoiseModel& noise,
                                              const LineFit& start, bool fit_width, int max_steps);

/// The background next to the line, from a few pixels beyond each flank. If the two sides differ by
/// more than a tenth of the line's height, one of them contains another line or an edge: then the
/// darker side is used.
/// @return nullopt if these pixels are outside the row.
[[nodiscard]] std::optional<FlankLevel> flank_level(std::span<const float> row,
                                                    const LineFit& line);

}  // namespace flytri::localization
