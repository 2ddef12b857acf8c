/// @file  Input events in order, and their distribution to frames: slow frames lose none.
#pragma once

#include <deque>
#include <variant>
#include <vector>

namespace flytri::ui {

/// A key by its GLFW name; a letter key by the letter printed on it. While a key is held, repeats
/// follow.
struct KeyEvent {
  int key = 0;
  int modifiers = 0;  ///< GLFW_MOD_*
  bool is_down = false;
  bool is_repeat = false;
};
/// Typed text, a code point.
struct CharacterEvent {
  unsigned code = 0;
};
/// In pixels of the framebuffer, from the upper left corner.
struct PointerEvent {
  float x_px = 0.0F, y_px = 0.0F;
};
struct ButtonEvent {
  int button = 0;  ///< 0 left, 1 right, 2 middle
  bool is_down = false;
};
struct WheelEvent {
  float x = 0.0F, y = 0.0F;
};
using InputEvent = std::variant<KeyEvent, CharacterEvent, PointerEvent, ButtonEvent, WheelEvent>;

/// Dear ImGui 1.86 reads the state of keys and buttons once a frame. It would miss a press and
/// release within one frame, and see a click followed by a motion at the wrong place. So a frame
/// takes events in order, until one would hide an earlier one. After Tab, events wait until the
/// next field has the focus: what is typed in between would be lost.
class InputQueue {
 public:
  void push(const InputEvent& event) { events_.push_back(event); }
  /// The events of the next frame, in order.
  [[nodiscard]] std::vector<InputEvent> take_frame();
  [[nodiscard]] bool empty() const { return events_.empty(); }

 private:
  std::deque<InputEvent> events_;
  int frames_to_wait_ = 0;
};

}  // namespace flytri::ui
