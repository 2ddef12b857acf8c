/// @file  Surfels of a mesh, as a scan would leave them: for benchmarks, tests and pictures.
#pragma once

#include <cstdint>

#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::ui {

/// About `count` surfels, one a cell of a grid that the mesh crosses, in blocks as LiveSurface
/// makes them. All are textured and covered well. The same for the same seed.
/// @param mesh  with vertex normals
[[nodiscard]] SurfelModel sample_surfels(const TriangleMesh& mesh, std::size_t count,
                                         std::uint64_t seed);

}  // namespace flytri::ui
