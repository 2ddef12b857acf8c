/// @file  A window with an OpenGL 3.3 core context, and all that the user does in it.
#pragma once

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
  /// Puts a picture of the window's size on the screen; does nothing where it is there already.
  /// @param changed  where the picture is another one than at the last call, px of the picture
  void show(const Framebuffer& picture, const std::vector<PixelBox>& changed);
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
  /// Whether the window still has the size that it had when this was last asked. Between the two,
  /// OpenGL saw a size when it drew, and a part is placed from the bottom of that: by another size
  /// it would lie outside of OpenGL's picture, and for that the X server ends the program.
  [[nodiscard]] bool keeps_its_size();
  GLFWwindow* window_;
  InputQueue input_;
  std::optional<PartialSwap> partial_swap_;
  ImageSize shown_size_;       ///< what keeps_its_size() last saw
  bool wants_refresh_ = true;  ///< the window system asks for the whole picture again
};

}  // namespace flytri::ui
