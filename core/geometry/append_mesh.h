/// @file  Puts meshes together.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri {

/// Adds all vertices and triangles of `part` to `mesh`.
inline void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const Triangle& t : part.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

}  // namespace flytri
