/// @file  One color from what several frames saw of a point.
#pragma once

#include <span>

#include "core/texture/observe.h"

namespace flytri::texture {

/// The weighted mean of the observations that agree: highlights, shadows and what passed in front
/// of the surface give way.
/// @param seen  at least one; reordered
/// @source  reweighted least squares with Cauchy's function, started at a weighted quantile.
[[nodiscard]] Vec3f merge_observations(std::span<Observation> seen);

}  // namespace flytri::texture
