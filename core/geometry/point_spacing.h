/// @file  The typical distance of neighboring points on the profiles of a scan.
#pragma once

#include <span>

#include "core/geometry/view.h"

namespace flytri {

/// Median over the profiles of their mean point spacing, mm; 0 without points. The natural unit of
/// lengths on the surface: it scales with the sensor.
[[nodiscard]] double median_point_spacing_mm(std::span<const AlignedView> views);

}  // namespace flytri
