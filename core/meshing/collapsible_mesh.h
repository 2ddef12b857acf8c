/// @file  A mesh whose vertices are taken away one by one, with the error that this has added.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/geometry/mesh_distance.h"
#include "core/geometry/triangle_mesh.h"
#include "core/meshing/mesh_lines.h"
#include "core/meshing/place_mesh.h"

namespace flytri::meshing {

/// What no step may exceed.
struct CollapseLimits {
  float max_mm = 0.0F;  ///< > 0, distance of a sample; of a rim's place also to the line of the rim
  float max_seam_mm = 0.0F;      ///< > 0, distance of a seam's place to the line of the seam
  float least_angle_rad = 0.0F;  ///< of a new triangle, unless one that it replaces was thinner
};

/// A triangle mesh in which a vertex can be moved onto a neighbor ("half-edge collapse"). What is
/// left is always a subset of the vertices as they were.
///
/// Seams of the texture stay lines of edges, as rims do.
///
/// The places and the middles of all triangles are samples of the original surface. Each sample
/// knows the triangle that replaces its own, so its distance is known at every step. A step that
/// would exceed a limit is refused. The middles of new triangles and edges are checked, too.
/// @source  half-edge collapse with bounded distance: Kobbelt, Campagna, Seidel, "A general
///          framework for mesh decimation", Graphics Interface 1998.
class CollapsibleMesh {
 public:
  /// @param mesh  kept by reference
  explicit CollapsibleMesh(const TriangleMesh& mesh);

  [[nodiscard]] const PlaceMesh& places() const { return places_; }
  /// The places that a place may move onto; empty if it must stay.
  void targets_of(std::uint32_t place, std::vector<std::uint32_t>& targets) const;

  /// Moves a place onto a neighbor, if the mesh stays a manifold, no triangle turns over, and no
  /// limit is exceeded.
  bool collapse(std::uint32_t from, std::uint32_t onto, const CollapseLimits& limits);
  /// Turns the edge between two triangles of a thin one, if this makes the thinner one less thin,
  /// under the same conditions. @returns whether it did
  bool flip(std::uint32_t triangle, const CollapseLimits& limits);

  /// Whether a triangle has an angle below the limit, or is turned over.
  [[nodiscard]] bool is_thin(std::uint32_t triangle, const CollapseLimits& limits) const;

  /// Mean of the squared distances of all samples.
  [[nodiscard]] double mean_square_mm2() const {
    return squares_mm2_ / static_cast<double>(squared_mm2_.size());
  }
  /// The largest distance of a sample, mm.
  [[nodiscard]] double max_mm() const;

 private:
  static constexpr std::uint32_t kNone = PlaceMesh::kNone;

  /// A new triangle of a step.
  struct NewTriangle {
    std::uint32_t slot = kNone;  ///< that it takes
    Triangle corners{};          ///< vertices of the mesh
    Vec3f a, b, c;
  };
  /// Where the samples of a step would go.
  struct Assignment {
    std::uint32_t sample, slot;
    float squared_mm2;
  };

  [[nodiscard]] bool keeps_manifold(std::uint32_t from, std::uint32_t onto) const;
  [[nodiscard]] bool prepare(std::uint32_t from, std::uint32_t onto);
  [[nodiscard]] float upright(const NewTriangle& t) const;
  [[nodiscard]] bool are_good(const CollapseLimits& limits) const;
  [[nodiscard]] bool line_stays(std::uint32_t from, std::uint32_t onto,
                                const CollapseLimits& limits) const;
  void list_new_middles(std::uint32_t onto);
  [[nodiscard]] bool is_near_former(float max_mm) const;
  [[nodiscard]] Vec3f sample_mm(std::uint32_t sample) const;
  [[nodiscard]] bool assign(std::uint32_t sample, float max_mm);
  [[nodiscard]] bool assign_star(float max_mm);
  void replace_star();
  [[nodiscard]] NewTriangle made(std::uint32_t slot, const Triangle& corners) const;

  const TriangleMesh& mesh_;
  PlaceMesh places_;
  MeshLines lines_;
  MeshDistance former_;                                    ///< the surface as it was
  std::vector<std::uint32_t> first_sample_, next_sample_;  ///< lists of samples by triangle
  std::vector<float> squared_mm2_;  ///< of each sample: the places, then the middles of triangles
  double squares_mm2_ = 0.0;

  // Scratch of one step.
  std::vector<std::uint32_t> star_, ring_, other_ring_;
  std::vector<NewTriangle> new_;
  std::vector<Vec3f> new_middles_mm_;  ///< of new triangles and new edges
  std::vector<Assignment> assigned_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> becomes_;
};

}  // namespace flytri::meshing
