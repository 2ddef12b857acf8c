/// @file  Finds the lamp of the texture frames from the brightness of the dots of a calibration
/// set.
#pragma once

#include <optional>

#include "core/base/workers.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// What the white of a dot target is taken to reflect. It only sets the brightness of all colors.
inline constexpr double kTargetAlbedo = 0.85;

/// Fits place, light and vignetting of the lamp to the middles of the dots in all planes.
/// @param texture_u_px, texture_v_px  of the same set
/// @returns nullopt if the dots do not show a small lamp beside the camera: they are lit from
///          elsewhere, saturated, or too few
[[nodiscard]] std::optional<Flash> fit_flash(const CalibrationSet& set,
                                             const TrivariateCubic& texture_u_px,
                                             const TrivariateCubic& texture_v_px,
                                             const Workers& workers);

}  // namespace flytri::calibration
