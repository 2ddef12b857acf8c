/// @file  How strongly a surface bends at its vertices: an edge of a preparation is where it bends
///          most.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/point_grid.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::review {

/// Finds the bending of a vertex when it is asked for, and keeps it.
class Bending {
 public:
  /// @param mesh  with unit normals; must outlive this
  /// @param radius_mm  > 0. The normals up to this distance count
  Bending(const TriangleMesh& mesh, double radius_mm);

  /// The larger principal curvature, 1/mm, by a linear fit of the normals around; positive where
  /// the surface bends away from the viewer outside, as at an edge. 0 where it bends inwards.
  /// @source  the shape operator from differences of normals: Rusinkiewicz, "Estimating curvatures
  ///          and their derivatives on triangle meshes", 3DPVT 2004; over all vertices within the
  ///          radius instead of a triangle's.
  [[nodiscard]] double convexity(std::uint32_t vertex);

  /// The vertices within a radius.
  void near(const Vec3& p_mm, double radius_mm, std::vector<Neighbor>& found) const;

 private:
  [[nodiscard]] double fit(std::uint32_t vertex);

  const TriangleMesh& mesh_;
  double radius_mm_;
  PointGrid grid_;
  std::vector<float> known_;  ///< NaN: not found yet
  std::vector<Neighbor> around_;
};

}  // namespace flytri::review
