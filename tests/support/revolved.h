/// @file  Surfaces of revolution with a known shape, among them prepared teeth, for tests.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri::testing {

/// Rotates a profile about the z axis. The outside is to the left of someone who walks along it,
/// with r to the right and z up: so it runs from the top outwards and down.
/// @param profile_mm  (r, z); a point with r = 0 becomes one vertex
[[nodiscard]] TriangleMesh revolved(const std::vector<Vec2>& profile_mm, int columns);

/// The same lines with a point at least every `step_mm`.
[[nodiscard]] std::vector<Vec2> divided(const std::vector<Vec2>& profile_mm, double step_mm);

/// A prepared tooth without its top, as a scan of it, with its true margin.
struct Preparation {
  TriangleMesh mesh;
  std::vector<Vec3> margin_mm;  ///< the middle of the rounded edge, closed, every 0.02 mm or so
};

/// The finish line of a preparation.
enum class FinishLine {
  kShoulder,  ///< a flat step; its edge turns by 84 degrees
  kChamfer    ///< a hollow of 1.2 mm radius; its edge turns by 71 degrees
};

struct PreparationOptions {
  FinishLine finish_line = FinishLine::kShoulder;
  double edge_radius_mm = 0.05;  ///< of the rounded edge
  double spacing_mm = 0.1;       ///< of the vertices; they do not lie along the edge
  double noise_mm = 0.01;        ///< standard deviation along the normal; also the mesh's sigma
  std::uint64_t seed = 1;
};

/// About 8 mm wide, oval, and its margin goes up and down by 0.4 mm.
[[nodiscard]] Preparation preparation(const PreparationOptions& options);

}  // namespace flytri::testing
