/// @file  Converts between rectangles from the upper edge of a picture, as in the window, and boxes
/// of pixels from the lower edge, as in OpenGL.
#pragma once

#include "ui/gpu/pixel_box.h"
#include "ui/widgets/rect.h"

namespace flytri::ui {

/// @param rect  whole pixels
[[nodiscard]] inline PixelBox from_below(const Rect& rect, float picture_height_px) {
  const Eigen::Array2i first(static_cast<int>(rect.x),
                             static_cast<int>(picture_height_px - rect.bottom()));
  const Eigen::Array2i size(static_cast<int>(rect.width), static_cast<int>(rect.height));
  return {first.matrix(), (first + size - 1).matrix()};
}

/// @param box  not empty
[[nodiscard]] inline Rect from_above(const PixelBox& box, float picture_height_px) {
  const Eigen::Array2f first = box.min().cast<float>(),
                       size = (box.sizes() + Eigen::Vector2i::Ones()).cast<float>();
  return {first.x(), picture_height_px - first.y() - size.y(), size.x(), size.y()};
}

}  // namespace flytri::ui
