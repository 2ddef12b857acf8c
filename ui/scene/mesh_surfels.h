/// @file  Turns a mesh into surfels, which draw faster than its triangles.
#pragma once

#include <vector>

#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::ui {

/// One surfel per vertex, in blocks, as wide as the spacing of the vertices. Deterministic.
/// @param mesh      with vertex normals; evenly spaced vertices
/// @param coverage  by vertex
[[nodiscard]] SurfelModel surfels_of(const TexturedMesh& mesh,
                                     const std::vector<Coverage>& coverage);

}  // namespace flytri::ui
