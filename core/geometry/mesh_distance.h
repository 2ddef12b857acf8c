/// @file  Finds the closest point on a triangle mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri {

/// A triangle mesh prepared for distance queries. Immutable; queries are thread-safe.
class MeshDistance {
 public:
  /// Copies the corners. Triangle indices must be valid; triangles with a coordinate that is not
  /// finite are skipped.
  explicit MeshDistance(const TriangleMesh& mesh);

  /// The point of the surface closest to a query.
  struct Closest {
    double distance_mm = 0.0;  ///< infinite if no surface is within the limit
    Vec3f point_mm = Vec3f::Zero();
    std::uint32_t triangle = 0;  ///< index in TriangleMesh::triangles
  };
  /// @param limit_mm  only surface up to this distance is searched
  [[nodiscard]] Closest closest(const Vec3f& query_mm, double limit_mm = 1e30) const;
  /// Whether any surface is within the limit: quicker than the closest point.
  [[nodiscard]] bool is_within(const Vec3f& query_mm, double limit_mm) const;

 private:
  struct Corners {
    Vec3f a, b, c;
    std::uint32_t triangle = 0;
  };
  // Bounding box of triangles. A leaf has the triangles [begin, end); other nodes have the children
  // `child` and `child` + 1.
  struct Node {
    Vec3f low = Vec3f::Zero(), high = Vec3f::Zero();
    std::uint32_t begin = 0, end = 0, child = 0;
  };
  enum class Wanted : char { kClosest, kAny };
  void split(std::uint32_t node);
  [[nodiscard]] Closest find(const Vec3f& query_mm, double limit_mm, Wanted wanted) const;

  std::vector<Corners> corners_;
  std::vector<Node> nodes_;
};

/// The point of triangle a, b, c closest to p.
/// @source  Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
[[nodiscard]] Vec3f closest_on_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b,
                                        const Vec3f& c);

}  // namespace flytri
