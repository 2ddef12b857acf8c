/// @file  A small closed mesh with colors or with a texture, for tests of exports.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri {

/// A sphere of 8 mm with a different color and uncertainty at every vertex, without texture.
[[nodiscard]] TexturedMesh colored_sphere();

/// The same sphere with a checkerboard texture of 64 x 32 pixels.
[[nodiscard]] TexturedMesh textured_sphere();

}  // namespace flytri
