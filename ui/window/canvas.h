/// @file  The window's picture, kept from frame to frame: what has not changed is not drawn again.
#pragma once

#include <vector>

#include "core/imaging/frame.h"
#include "ui/gpu/texture.h"
#include "ui/theme/status_colors.h"
#include "ui/widgets/rect.h"

namespace flytri::ui {

/// Lives in the window's context. What lies in a window's framebuffer after it was shown is not
/// defined, so the picture is kept in a texture and copied as a whole.
class Canvas {
 public:
  /// An empty picture where the size is another one.
  /// @return  whether it is
  bool resize(const ImageSize& size);
  /// Draws what lies in the boxes; the rest stays as it was.
  /// @param data  as Dear ImGui's Render() left it; clip rectangles are narrowed and restored
  void draw(ImDrawData& data, const std::vector<Rect>& boxes, const Color& background);
  [[nodiscard]] const Framebuffer& picture() const { return framebuffer_; }

 private:
  Texture picture_;
  Framebuffer framebuffer_;
};

}  // namespace flytri::ui
