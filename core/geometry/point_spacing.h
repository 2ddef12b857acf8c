/// @file  Typical distance of neighboring points on the profiles of a scan.
#pragma once

#include <span>

#include "core/geometry/view.h"

namespace flytri {

/// Median of the mean point spacings of the profiles, mm; 0 without points. Lengths on the surface
/// are given in this unit, because it scales with the sensor.
[[nodiscard]] double median_point_spacing_mm(std::span<const AlignedView> views);

}  // namespace flytri
