/// @file  Points of a surface as bytes, to compare two surfaces to the bit.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace flytri::testing {

/// Position, normal, sigma, color and patterns of each point in a ball, sorted: the order of the
/// points does not count.
[[nodiscard]] std::vector<std::string> bits_in_ball(const std::vector<SurfacePoint>& points,
                                                    const Vec3f& middle_mm, float radius_mm);

}  // namespace flytri::testing
