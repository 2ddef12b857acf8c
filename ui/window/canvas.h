/// @file  The picture of the window, kept between frames; only changed parts are drawn.
#pragma once

#include <vector>

#include "core/imaging/frame.h"
#include "ui/gpu/texture.h"
#include "ui/theme/status_colors.h"
#include "ui/widgets/rect.h"

namespace flytri::ui {

/// Needs the context of the window. The content of a framebuffer is undefined after it was shown,
/// so the picture is kept in a texture and copied.
class Canvas {
 public:
  /// Starts an empty picture if the size changed.
  /// @return  whether it changed
  bool resize(const ImageSize& size);
  /// Draws the content of the boxes; the rest stays.
  /// @param data  of Dear ImGui's Render(); clip rectangles are narrowed and restored
  void draw(ImDrawData& data, const std::vector<Rect>& boxes, const Color& background);
  [[nodiscard]] const Framebuffer& picture() const { return framebuffer_; }

 private:
  Texture picture_;
  Framebuffer framebuffer_;
};

}  // namespace flytri::ui
