/// @file  A window with an OpenGL 3.3 core context, and its input events.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/imaging/frame.h"
#include "ui/gpu/texture.h"
#include "ui/window/input.h"
#include "ui/window/partial_swap.h"

struct GLFWwindow;

namespace flytri::ui {

struct WindowOptions {
  std::string title;
  ImageSize size;  ///< of the framebuffer at a content scale of 1
  bool waits_for_screen = true;
};

/// One per process: opens and closes the window system.
class Window {
 public:
  /// Makes the context current in the calling thread.
  /// @errors  kNotFound without a display or OpenGL 3.3
  [[nodiscard]] static Result<std::unique_ptr<Window>> open(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Takes new events of the window system, without waiting.
  void poll();
  /// Shows a picture of the size of the window; does nothing if nothing changed.
  /// @param changed  where the picture changed since the last call, px of the picture
  void show(const Framebuffer& picture, const std::vector<PixelBox>& changed);
  /// Fills the screen that holds most of the window, or returns to where it was.
  void set_full_screen(bool is_full);
  [[nodiscard]] bool is_full_screen() const;
  [[nodiscard]] bool has_focus() const;
  [[nodiscard]] bool should_close() const;
  /// The user did not mean to close it.
  void keep_open();
  [[nodiscard]] ImageSize framebuffer_size() const;
  /// Pixels by pixels of an ordinary screen.
  [[nodiscard]] double content_scale() const;
  [[nodiscard]] InputQueue& input() { return input_; }
  [[nodiscard]] GLFWwindow* handle() const { return window_; }

 private:
  explicit Window(GLFWwindow* window);
  void listen();
  static void on_refresh(GLFWwindow* window);
  /// Whether the window has the same size as at the last call. A part is placed from the bottom of
  /// the size that OpenGL saw when drawing; with another size it could lie outside of the picture,
  /// and the X server would end the program.
  [[nodiscard]] bool keeps_its_size();
  GLFWwindow* window_;
  InputQueue input_;
  std::optional<PartialSwap> partial_swap_;
  std::array<int, 4> place_ = {};  ///< before it filled the screen: left, top, width, height
  ImageSize shown_size_;           ///< what keeps_its_size() last saw
  bool wants_refresh_ = true;      ///< the window system needs the whole picture again
};

}  // namespace flytri::ui
