/// @file  Vertex colors from the atlas, for formats without an atlas.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri::texture {

/// Gives each vertex its color in the atlas. Does nothing without an atlas.
void color_vertices(TexturedMesh& model);

}  // namespace flytri::texture
