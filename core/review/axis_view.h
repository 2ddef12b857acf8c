/// @file  A mesh seen along an axis from far away: what is hidden, and how far to the side the way
///          out begins.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace flytri::review {

/// Coordinates of the view: z along the axis towards the viewer, x and y across.
///
/// Immutable; queries are thread-safe.
class AxisView {
 public:
  /// @param mesh  indices valid, positions finite
  /// @param axis  unit, towards the viewer
  AxisView(const TriangleMesh& mesh, const Vec3& axis);

  /// A place inside a triangle, by its barycentric shares.
  struct Place {
    std::uint32_t triangle = 0;
    Vec3 shares = Vec3::Constant(1.0 / 3.0);
  };
  [[nodiscard]] Vec3 position_mm(const Place& place) const;
  /// Whether the viewer does not see the place: it faces away, or other surface is before it.
  [[nodiscard]] bool is_hidden(const Place& place) const;

  /// The highest surface over a grid.
  struct HeightMap {
    double step_mm = 0.0;
    Vec2 low_mm = Vec2::Zero();
    int columns = 0, rows = 0;
    std::vector<float> height_mm;  ///< at the middles of the cells, row by row; -infinity: none
    /// Whether a point at this height is free to go up from a cell. Beyond the grid it is.
    [[nodiscard]] bool is_free(int column, int row, double z_mm) const;
  };
  [[nodiscard]] HeightMap height_map(double step_mm) const;

 private:
  enum class Side : char { kFacing, kAlong, kAway };
  struct Flat {
    Vec3 a, b, c;  ///< corners in the view
    Vec3 normal;   ///< unit, or 0 for a triangle without area
    Side side = Side::kAlong;
  };
  [[nodiscard]] static bool height_at(const Flat& flat, double x_mm, double y_mm, double& z_mm);
  [[nodiscard]] int column_of(double x_mm) const;
  [[nodiscard]] int row_of(double y_mm) const;
  void fill_cells();

  std::vector<Flat> flats_;  ///< parallel to the triangles
  Vec2 low_mm_ = Vec2::Zero(), high_mm_ = Vec2::Zero();
  double cell_mm_ = 1.0;
  int columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> starts_, triangles_;  ///< of each cell: triangles over it
};

}  // namespace flytri::review
