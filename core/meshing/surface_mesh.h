/// @file  A triangle mesh of a measured surface and the list of places where it is open.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri::meshing {

/// A closed chain of edges that have a triangle on one side only: the rim of a place that was not
/// measured.
struct BoundaryLoop {
  std::vector<std::uint32_t> vertices;  ///< in order, the surface to the right seen from outside
  double perimeter_mm = 0.0;
  double area_mm2 = 0.0;            ///< estimate: area of the loop projected along its mean normal
  double width_mm = 0.0;            ///< of the widest place within, islands left out
  Vec3f center_mm = Vec3f::Zero();  ///< of the widest place
  Vec3f normal = Vec3f::UnitZ();    ///< unit, outwards: mean normal of the rim around there
  bool is_outer = false;            ///< the border of the scan, not a hole in it
};

struct SurfaceMesh {
  TriangleMesh mesh;
  std::vector<BoundaryLoop> boundaries;  ///< see find_boundaries()
};

}  // namespace flytri::meshing
