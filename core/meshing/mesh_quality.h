/// @file  Whether a mesh is fit for CAD: manifold, oriented, without slivers.
#pragma once

#include <cstddef>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// Thinner triangles count as slivers.
inline constexpr double kSliverAngle_rad = 0.174533;  // 10 degrees

struct MeshQuality {
  std::size_t triangles = 0;
  std::size_t vertices = 0;    ///< that triangles use
  std::size_t boundaries = 0;  ///< closed lines with a triangle on one side
  std::size_t components = 0;
  bool is_manifold = true;  ///< at most two triangles at an edge, one fan of triangles at a vertex
  bool is_oriented = true;  ///< neighbors have the same side outside
  /// Circumradius by twice the inradius: 1 for equal sides. Infinite: a triangle without area.
  double worst_aspect = 1.0;
  double least_angle_rad = 0.0;
  double sliver_share = 0.0;     ///< of the triangles, 0..1
  std::size_t turned = 0;        ///< triangles that face away from the normals of their corners
  std::size_t not_measured = 0;  ///< vertices of closed holes
};

/// @param mesh  indices valid; of a textured one welded(): cuts between charts would count as
///              boundaries
[[nodiscard]] MeshQuality mesh_quality(const TriangleMesh& mesh);

}  // namespace flytri::meshing
