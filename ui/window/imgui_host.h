/// @file  The context of Dear ImGui: gets the events of the window, draws with OpenGL.
#pragma once

#include <memory>
#include <set>

#include "core/base/result.h"
#include "ui/theme/theme.h"
#include "ui/window/canvas.h"
#include "ui/window/draw_damage.h"
#include "ui/window/window.h"

struct ImGuiContext;

namespace flytri::ui {

/// Owns the context, of which a process has one. Writes nothing to disk.
class ImGuiHost {
 public:
  explicit ImGuiHost(Window& window);
  ~ImGuiHost();
  ImGuiHost(const ImGuiHost&) = delete;
  ImGuiHost& operator=(const ImGuiHost&) = delete;

  /// Sets fonts and sizes for a scale; does nothing if it is already set.
  /// @errors  those of make_theme.
  [[nodiscard]] Result<void> set_scale(float scale);
  [[nodiscard]] const Theme& theme() const { return theme_; }

  /// Begins a frame of Dear ImGui with the next events of the window.
  /// @param size  of the window in this frame
  /// @param now_s  monotonic
  /// @return  keys pressed and repeated in this frame, in order; without those of text fields
  [[nodiscard]] std::vector<KeyEvent> begin_frame(const ImageSize& size, double now_s);
  /// Draws what changed since the previous frame.
  /// @param repainted  where the content of textures changed
  /// @return  where it changed, px of the canvas
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
  std::set<int> held_keys_;  ///< GLFW_KEY_*
  double last_now_s_ = -1.0;
};

}  // namespace flytri::ui
