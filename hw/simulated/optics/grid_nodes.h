/// @file  The surface points hit by the rays of one exposure, on a grid over the image.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::simulated {

/// kUnknown: not computed.
enum class Shadow : std::uint8_t { kUnknown, kLit, kDark };

/// Result of one ray; sensor frame, single precision.
struct GridNode {
  bool met = false;   ///< the ray hit a surface
  bool seen = false;  ///< the lines of the slide reach the point, and the camera does not see it at
                      ///< a flat angle
  Shadow shadow = Shadow::kUnknown;
  std::uint8_t before = 0;     ///< number of lines on the slide before its place
  std::uint32_t triangle = 0;  ///< of the scene's mesh
  float u = 0.0F, v = 0.0F;    ///< weights of the second and third vertex
  Vec3f position_mm, normal;
  float facing = 0.0F;       ///< cosine between normal and line of sight
  float distance_mm = 0.0F;  ///< from the camera
  float across = 0.0F;       ///< place on the slide
  float blur = 0.0F;         ///< of the projector at this point
  float away = 0.0F;  ///< distance on the slide from the nearest line's light; negative if lit
  // Only of lit nodes:
  float share = 1.0F;       ///< share of the pupil's light that is not blocked
  float brightness = 0.0F;  ///< without the factor `share`
  float begin_shift = 0.0F,
        end_shift = 0.0F;  ///< shift of the place on the slide by motion during the exposure
};

/// Traced nodes of one exposure, by column and row.
class GridNodes {
 public:
  /// Upper left, upper right, lower left, lower right; null if not traced.
  using Corners = std::array<const GridNode*, 4>;

  GridNodes(int columns, int rows)
      : columns_(columns), rows_(rows), places_(static_cast<std::size_t>(columns) * rows, -1) {}

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int index(int column, int row) const { return row * columns_ + column; }
  [[nodiscard]] bool traced(int node) const { return places_[node] >= 0; }
  void reserve(std::size_t count) { list_.reserve(list_.size() + count); }
  void add(int node, const GridNode& what) {
    places_[node] = static_cast<int>(list_.size());
    list_.push_back(what);
  }
  /// A traced node; the reference is valid until a node is added.
  [[nodiscard]] GridNode& operator[](int node) { return list_[places_[node]]; }
  /// The pointer is valid until a node is added. Null outside the grid or if not traced.
  [[nodiscard]] const GridNode* at(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nullptr;
    const int place = places_[index(column, row)];
    return place < 0 ? nullptr : &list_[place];
  }
  [[nodiscard]] Corners corners(int column, int row, int size) const {
    return {at(column, row), at(column + size, row), at(column, row + size),
            at(column + size, row + size)};
  }

 private:
  int columns_, rows_;
  std::vector<int> places_;  // by node
  std::vector<GridNode> list_;
};

}  // namespace flytri::simulated
