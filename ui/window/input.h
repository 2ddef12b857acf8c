/// @file  What the user did, in order: events from the window's callbacks, and how they are dealt
/// out to frames so that slow ones lose none.
#pragma once

#include <deque>
#include <variant>
#include <vector>

namespace flytri::ui {

/// A key as GLFW names it; a letter key is named by the letter printed on it. Repeats follow a
/// press while the key is held.
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

/// Dear ImGui 1.86 sees the state of keys and buttons once a frame. Of a press and its release
/// within one frame it would see nothing, of a click and a later motion a click at the wrong place:
/// so a frame takes events in order only until one would hide an earlier one.
class InputQueue {
 public:
  void push(const InputEvent& event) { events_.push_back(event); }
  /// The events of the next frame, in order.
  [[nodiscard]] std::vector<InputEvent> take_frame();
  [[nodiscard]] bool empty() const { return events_.empty(); }

 private:
  std::deque<InputEvent> events_;
};

}  // namespace flytri::ui
