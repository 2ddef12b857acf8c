/// @file  Measures whether the colors of a result are at the right places.
#pragma once

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::evaluation {

/// Differences of chromaticity: each channel's share of the linear light, 0..1, the worst channel.
/// Brightness is ignored, because it depends on the lighting.
struct ColorError {
  std::int64_t count = 0;  ///< vertices near a true vertex
  double median = 0.0;
  double percentile_95 = 0.0;
  /// Mean over vertices and channels of the difference of sRGB values, 0..255, brightness included.
  double mean_srgb = 0.0;
  /// Median difference to a true vertex elsewhere: the value that misplaced colors would give.
  double median_by_chance = 0.0;
};

/// Compares each vertex with the nearest true one.
/// @param result     in the frame of the truth; colors come from the atlas if there is one
/// @param within_mm  > 0. Vertices farther from all true vertices are ignored.
[[nodiscard]] ColorError color_error(const TexturedMesh& result, const TriangleMesh& truth,
                                     double within_mm, const Workers& workers);

}  // namespace flytri::evaluation
