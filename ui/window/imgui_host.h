/// @file  Dear ImGui's context: fed from the window's event queue, drawn with OpenGL.
#pragma once

#include <memory>

#include "core/base/result.h"
#include "ui/theme/theme.h"
#include "ui/window/canvas.h"
#include "ui/window/draw_damage.h"
#include "ui/window/window.h"

struct ImGuiContext;

namespace flytri::ui {

/// Owns the context, which Dear ImGui keeps as the one current context of the process. Nothing is
/// written to disk.
class ImGuiHost {
 public:
  explicit ImGuiHost(Window& window);
  ~ImGuiHost();
  ImGuiHost(const ImGuiHost&) = delete;
  ImGuiHost& operator=(const ImGuiHost&) = delete;

  /// Fonts and sizes for a scale; nothing happens where it is the one already set.
  /// @errors  those of make_theme.
  [[nodiscard]] Result<void> set_scale(float scale);
  [[nodiscard]] const Theme& theme() const { return theme_; }

  /// Opens a frame of Dear ImGui with the next events of the window.
  /// @param size  of the window in this frame
  /// @param now_s  monotonic
  /// @return  keys pressed and repeated in this frame while no text field wanted them, in order
  [[nodiscard]] std::vector<KeyEvent> begin_frame(const ImageSize& size, double now_s);
  /// Draws what is different from the frame before.
  /// @param repainted  where textures hold another picture than before
  /// @return  where it is, px of the canvas
  std::vector<PixelBox> end_frame(const std::vector<Rect>& repainted);
  /// The frame as it was drawn.
  [[nodiscard]] const Canvas& canvas() const { return canvas_; }

 private:
  Window& window_;
  ImGuiContext* context_;
  Theme theme_;
  ImageSize size_;  ///< of the window in this frame
  DrawDamage damage_;
  Canvas canvas_;
  double last_now_s_ = -1.0;
};

}  // namespace flytri::ui
