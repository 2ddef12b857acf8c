/// @file  A window with an OpenGL 3.3 core context, and all that the user does in it.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "core/imaging/frame.h"
#include "ui/window/input.h"

struct GLFWwindow;

namespace flytri::ui {

struct WindowOptions {
  std::string title;
  ImageSize size;  ///< of the framebuffer at a content scale of 1
  bool waits_for_screen = true;
};

/// One for a process: the window system is opened and closed with it.
class Window {
 public:
  /// The context is current to the calling thread afterwards.
  /// @errors  kNotFound where there is no display or no OpenGL 3.3.
  [[nodiscard]] static Result<std::unique_ptr<Window>> open(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Takes what the window system has for us, without waiting.
  void poll();
  /// Shows what was drawn.
  void swap();
  /// Whether the window system asked for the picture again since the last time.
  [[nodiscard]] bool take_refresh() { return std::exchange(wants_refresh_, false); }
  [[nodiscard]] bool should_close() const;
  [[nodiscard]] ImageSize framebuffer_size() const;
  /// Pixels by pixels of an ordinary screen.
  [[nodiscard]] double content_scale() const;
  [[nodiscard]] InputQueue& input() { return input_; }
  [[nodiscard]] GLFWwindow* handle() const { return window_; }

 private:
  explicit Window(GLFWwindow* window);
  void listen();
  static void on_refresh(GLFWwindow* window);
  GLFWwindow* window_;
  InputQueue input_;
  bool wants_refresh_ = true;
};

}  // namespace flytri::ui
