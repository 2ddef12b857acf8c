/// @file  A mesh as surfels: what is drawn of it where its triangles take too long.
#pragma once

#include <vector>

#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::ui {

/// One surfel a vertex, in blocks, as wide as the vertices' spacing. The same for the same mesh.
/// @param mesh      with vertex normals; vertices about evenly spread
/// @param coverage  by vertex
[[nodiscard]] SurfelModel surfels_of(const TexturedMesh& mesh,
                                     const std::vector<Coverage>& coverage);

}  // namespace flytri::ui
