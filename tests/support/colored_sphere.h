/// @file  A small closed mesh with colors or with a texture, for tests of exports.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri {

/// A sphere of 8 mm with a color and an uncertainty of its own at every vertex; no texture.
[[nodiscard]] TexturedMesh colored_sphere();

/// The same with a checkered atlas of 64 x 32 pixels wrapped around it.
[[nodiscard]] TexturedMesh textured_sphere();

}  // namespace flytri
