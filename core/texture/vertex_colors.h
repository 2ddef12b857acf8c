/// @file  Colors of a textured mesh's vertices, for formats that carry no atlas.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri::texture {

/// Gives each vertex the color of its place in the atlas. Does nothing where there is no atlas.
void color_vertices(TexturedMesh& model);

}  // namespace flytri::texture
