/// @file  The surface of a scanned jaw, prepared for laying other points on it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/mesh_distance.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::occlusion {

/// Immutable; queries are thread-safe.
class JawSurface {
 public:
  /// @param mesh  welded, with unit normals; must outlive this
  explicit JawSurface(const TriangleMesh& mesh);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

  /// The place of the surface that is nearest to a point.
  struct Foot {
    Vec3 point_mm = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();  ///< unit, interpolated between the vertices
    double offset_mm = 0.0;       ///< of the point along the normal; negative: behind the surface
  };
  /// None if no surface is within `limit_mm`, or if the nearest place is at a rim: beyond it, the
  /// surface was not scanned.
  [[nodiscard]] std::optional<Foot> foot(const Vec3& p_mm, double limit_mm) const;

 private:
  const TriangleMesh& mesh_;
  MeshDistance distance_;
  std::vector<bool> is_at_rim_;  ///< by triangle
};

}  // namespace flytri::occlusion
