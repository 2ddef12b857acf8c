/// @file  The weighted fit of one line cross-section: a Gaussian above a straight background.
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
  float center_variance = 0;  ///< px^2, by the noise model
};

/// Background under a line: `level` at its center, rising by `slope` per px.
struct FlankLevel {
  float level = 0;
  float slope = 0;
};

/// What a fit looks at.
struct LineWindow {
  std::span<const float> row;
  FlankLevel background;
  float reach_px = 0;         ///< pixels farther from the start's center are left out
  float full_scale = 255.0F;  ///< pixels at or above it are clipped: they are left out too
};

/// Improves `start` by at most `max_steps` Gauss-Newton steps, fewer where they are small. Each
/// pixel weighs the inverse of its variance and, toward the ends of the window, ever less, so that
/// no pixel enters with a jump.
///
/// Under speckle the flanks, where light changes fastest for its amount, tell the position best;
/// the three points at the top tell little.
/// @source  replaces the three-point interpolation of Arold et al., "Line Localization"; measured
///          gain: see tests/unit/localization/localize_test.cpp.
/// @param fit_width  false keeps the width.
/// @return nothing if the window leaves the row or the pixels do not determine the line.
[[nodiscard]] std::optional<LineFit> fit_line(const LineWindow& window, const NoiseModel& noise,
                                              const LineFit& start, bool fit_width, int max_steps);

/// The background beside the line, from a few pixels beyond each flank. Sides that differ by more
/// than a tenth of the line's height hold another line or an edge: then the darker side counts.
/// @return nothing if the row ends there.
[[nodiscard]] std::optional<FlankLevel> flank_level(std::span<const float> row,
                                                    const LineFit& line);

}  // namespace flytri::localization
