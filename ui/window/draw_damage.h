/// @file  Finds the parts of the window that look different from the frame before.
///
/// Without a graphics card every pixel that is drawn is work for the processor that scans. Most of
/// the window is the same from frame to frame: what Dear ImGui wants drawn is compared tile by
/// tile.
#pragma once

#include <cstdint>
#include <vector>

#include "ui/widgets/rect.h"

namespace flytri::ui {

class DrawDamage {
 public:
  /// @param repainted  where a texture's content is another one: the triangles do not tell
  /// @return  a few boxes of whole tiles, px, that hold every difference; they may overlap
  [[nodiscard]] std::vector<Rect> update(const ImDrawData& data,
                                         const std::vector<Rect>& repainted);
  /// Everything is different in the next update.
  void forget() { prints_.clear(); }

 private:
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint64_t> prints_;  ///< by tile: of all triangles that reach into it, in order
};

}  // namespace flytri::ui
