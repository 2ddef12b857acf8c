/// @file  Measures how true the colors of a result are, as an eye sees the difference.
#pragma once

#include <cstdint>

#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::evaluation {

/// Differences in CIELAB (D65) of vertices and the true surface, after one gain for all light.
/// About 1 can just be seen.
/// @source  CIE 1976, "Delta E*ab".
struct DeltaE {
  std::int64_t count = 0;  ///< vertices near the true surface
  double gain = 1.0;       ///< of the linear light of the result: makes the median brightness right
  double median = 0.0;
  double percentile_95 = 0.0;
};

/// Compares each vertex with the closest point of the true surface, whose color is interpolated.
/// @param result     in the frame of the truth; colors come from the atlas if there is one
/// @param within_mm  > 0. Vertices farther from the true surface are ignored.
[[nodiscard]] DeltaE delta_e(const TexturedMesh& result, const TriangleMesh& truth,
                             double within_mm, const Workers& workers);

}  // namespace flytri::evaluation
