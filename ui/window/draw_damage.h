/// @file  Finds the parts of the window that differ from the previous frame.
///
/// Without a graphics card, drawing takes processor time from the scan, and most of the window does
/// not change. So the output of Dear ImGui is compared with that of the previous frame, tile by
/// tile.
#pragma once

#include <cstdint>
#include <vector>

#include "ui/widgets/rect.h"

namespace flytri::ui {

class DrawDamage {
 public:
  /// @param repainted  where the content of a texture changed, which triangles do not show
  /// @return  a few boxes of whole tiles, px, that contain every difference; they may overlap
  [[nodiscard]] std::vector<Rect> update(const ImDrawData& data,
                                         const std::vector<Rect>& repainted);
  /// The next update reports everything as different.
  void forget() { prints_.clear(); }

 private:
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint64_t> prints_;  ///< by tile: of all triangles that reach into it, in order
};

}  // namespace flytri::ui
