/// @file  Cross-sections of one line beside a highlight: sprayed, bare and wet.
#pragma once

#include <array>

#include "core/base/result.h"
#include "hw/drawing/drawing.h"
#include "hw/simulated/optics/tooth_light.h"

namespace flytri::lab {

/// A chart of three cross-sections at the middle depth, without noise, with their localized
/// centers.
/// @param surfaces  sprayed, bare, wet
/// @errors  kInsufficient: a line was not localized; as localization::localize_lines.
[[nodiscard]] Result<drawing::Drawing> enamel_picture(
    const simulated::SensorModel& sensor, const std::array<simulated::ToothSurface, 3>& surfaces);

}  // namespace flytri::lab
