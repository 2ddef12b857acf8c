/// @file  Whether the colors of a result are where they belong.
#pragma once

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::evaluation {

/// Differences of chromaticity: each channel's share of the linear light, 0..1, the worst channel.
/// Brightness is left out: it depends on how the light fell.
struct ColorError {
  std::int64_t count = 0;  ///< vertices that lie near a true one
  double median = 0.0;
  double percentile_95 = 0.0;
  /// Mean over vertices and channels of the difference of sRGB values, 0..255, brightness included.
  double mean_srgb = 0.0;
  /// The median between each vertex and a true one anywhere: what misplaced colors would give.
  double median_by_chance = 0.0;
};

/// Compares each vertex with the nearest true one.
/// @param result     in the frame of the truth; the color is the atlas's where there is one
/// @param within_mm  > 0. Vertices farther from any true one are left out.
[[nodiscard]] ColorError color_error(const TexturedMesh& result, const TriangleMesh& truth,
                                     double within_mm, const Workers& workers);

}  // namespace flytri::evaluation
