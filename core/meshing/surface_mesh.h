/// @file  A triangle mesh of a measured surface with its boundary loops.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// A closed chain of edges with a triangle on one side only: the border of a place that was not
/// measured.
struct BoundaryLoop {
  std::vector<std::uint32_t> vertices;  ///< in order; seen from outside, the surface is on the
                                        ///< right
  std::vector<Vec3f> rim_mm;            ///< their positions
  double perimeter_mm = 0.0;
  double area_mm2 = 0.0;            ///< estimate: area of the loop projected along its mean normal
  double width_mm = 0.0;            ///< of the widest place inside, without islands
  Vec3f center_mm = Vec3f::Zero();  ///< of the widest place
  Vec3f normal = Vec3f::UnitZ();    ///< unit, outwards: mean normal of the loop near the center
  bool is_outer = false;            ///< the outer border of a component, not a hole
};

struct SurfaceMesh {
  TriangleMesh mesh;
  std::vector<BoundaryLoop> boundaries;  ///< see find_boundaries()
  std::size_t closed_holes = 0;          ///< holes that were closed, see close_holes()
  double spacing_mm = 0.0;               ///< of the vertices, see MeshOptions; 0: not known
};

}  // namespace flytri::meshing
