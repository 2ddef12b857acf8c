/// @file  Answers which point of a triangle mesh a ray meets first.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "hw/simulated/optics/ray_packet.h"

namespace flytri::simulated {

/// A half line in the model frame, mm. `direction` need not be unit.
struct Ray {
  Vec3 origin_mm = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();
};

/// Where a ray met the mesh.
struct RayHit {
  Vec3 point_mm;           ///< on the triangle, to a float's precision
  Vec3 normal;             ///< unit, of the flat triangle, outwards (counter-clockwise side)
  std::uint32_t triangle;  ///< index in TriangleMesh::triangles
  Vec3 weights;            ///< barycentric, of the triangle's three vertices
};

/// A mesh prepared for ray casting with Embree. Immutable; all members are thread-safe, and the
/// answers are the same on every run.
class RayScene {
 public:
  /// Copies what it needs of the mesh. Triangle indices must be valid.
  explicit RayScene(const TriangleMesh& mesh);

  /// The first point on the ray, or none.
  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const;

  /// The same for many rays that run close to each other, which is several times faster.
  /// `hits` has the size of `rays`.
  void first_hits(std::span<const Ray> rays, std::span<std::optional<RayHit>> hits) const;

  /// The same for eight rays from one place, in the frame of who looks.
  /// @param origin_mm  of the rays, in frame `sensor`, like the packet's directions and its answers
  void first_hits(const Isometry& T_model_sensor, const Vec3& origin_mm, RayPacket& packet) const;

  /// True if something lies between a surface point and a place away from the surface. `normal`
  /// is the surface's at `point_mm`; it keeps the surface from blocking itself.
  [[nodiscard]] bool blocked(const Vec3& point_mm, const Vec3& normal, const Vec3& to_mm) const;

  /// The same for many surface points that lie close to each other and look at one place.
  struct Shadow {
    Vec3 point_mm, normal;
    bool blocked = false;  ///< the answer
  };
  void cast_shadows(std::span<Shadow> shadows, const Vec3& to_mm) const;

  /// The mesh that was given.
  [[nodiscard]] const TriangleMesh& mesh() const;

 private:
  struct Embree;
  std::shared_ptr<const Embree> embree_;
};

/// Vertex color at a hit, interpolated, 0..255 a channel, sRGB as in the mesh.
[[nodiscard]] Vec3 color_at(const TriangleMesh& mesh, const RayHit& hit);

/// Vertex normal at a hit, interpolated and unit; the triangle's own where it would vanish.
[[nodiscard]] Vec3 smooth_normal_at(const TriangleMesh& mesh, const RayHit& hit);

}  // namespace flytri::simulated
