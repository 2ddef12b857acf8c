/// @file  Two closed jaws, and what a sensor sees of them from one cheek.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/jaw_axes.h"

namespace flytri::testing {

/// A sample jaw with few triangles.
[[nodiscard]] TriangleMesh coarse_jaw(JawKind kind, std::uint64_t seed);

/// T_upper_lower. Half a turn about y: z points to the opposing teeth in both frames. The jaws do
/// not touch.
[[nodiscard]] Isometry bite_relation();

/// The points, with noise, in a frame of their own.
class Cheek {
 public:
  Cheek(const TriangleMesh& upper, const TriangleMesh& lower, const Isometry& T_upper_lower,
        bool is_right, std::uint64_t seed);
  [[nodiscard]] const std::vector<SurfacePoint>& points() const { return mesh_.vertices; }
  /// With the triangles between the points.
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// The part that lies on the upper jaw.
  [[nodiscard]] std::vector<SurfacePoint> upper_part() const {
    return {points().begin(), points().begin() + static_cast<std::ptrdiff_t>(upper_count_)};
  }
  /// Adds a cheek: a wavy surface in front of the teeth.
  void add_tissue(std::size_t count);

 private:
  void add(const TriangleMesh& jaw, const Isometry& T_upper_jaw);

  Random random_;
  bool is_right_;
  Isometry T_bite_upper_;
  TriangleMesh mesh_;
  std::size_t upper_count_ = 0;
};

}  // namespace flytri::testing
