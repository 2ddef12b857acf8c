/// @file  The z-buffer of one texture frame, in coarse cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/imaging/frame.h"
#include "core/imaging/pattern.h"

namespace flytri::texture {

/// Depth of the closest point in each cell of the image.
class DepthBuffer {
 public:
  DepthBuffer(ImageSize size, int cell_px)
      : cell_px_(cell_px),
        width_(size.width_px / cell_px + 1),
        height_(size.height_px / cell_px + 1),
        depths_mm_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                   std::numeric_limits<float>::infinity()) {}

  /// @param pixel  inside the image, as for all of these
  void add(const Pixel& pixel, float depth_mm) {
    float& closest = depths_mm_[index(column(pixel), row(pixel))];
    closest = std::min(closest, depth_mm);
  }
  [[nodiscard]] float closest_mm(const Pixel& pixel) const {
    return depths_mm_[index(column(pixel), row(pixel))];
  }
  /// The closest point of the cell and the eight around it.
  [[nodiscard]] float closest_around_mm(const Pixel& pixel) const {
    float closest = std::numeric_limits<float>::infinity();
    const int x = column(pixel), y = row(pixel);
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height_ - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width_ - 1); ++i) {
        closest = std::min(closest, depths_mm_[index(i, j)]);
      }
    }
    return closest;
  }

 private:
  [[nodiscard]] int column(const Pixel& p) const { return static_cast<int>(p.u_px / cell_px_); }
  [[nodiscard]] int row(const Pixel& p) const { return static_cast<int>(p.v_px / cell_px_); }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  double cell_px_;
  int width_, height_;
  std::vector<float> depths_mm_;
};

}  // namespace flytri::texture
