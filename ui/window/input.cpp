#include "ui/window/input.h"

#include <GLFW/glfw3.h>

#include <set>

namespace flytri::ui {
namespace {

/// The events taken for the frame so far.
struct Taken {
  bool has_button = false;
  std::set<int> keys;

  [[nodiscard]] bool would_hide(const InputEvent& event) const {
    if (const auto* key = std::get_if<KeyEvent>(&event)) return keys.contains(key->key);
    // After a click, pointer motions and further clicks have to wait.
    return has_button && (std::holds_alternative<ButtonEvent>(event) ||
                          std::holds_alternative<PointerEvent>(event));
  }
  void add(const InputEvent& event) {
    if (const auto* key = std::get_if<KeyEvent>(&event)) keys.insert(key->key);
    if (std::holds_alternative<ButtonEvent>(event)) has_button = true;
  }
};

bool moves_focus(const InputEvent& event) {
  const auto* key = std::get_if<KeyEvent>(&event);
  return key != nullptr && key->key == GLFW_KEY_TAB && key->is_down;
}

}  // namespace

std::vector<InputEvent> InputQueue::take_frame() {
  constexpr int kFramesToFocus = 2;
  if (frames_to_wait_ > 0) {
    --frames_to_wait_;
    return {};
  }
  std::vector<InputEvent> frame;
  Taken taken;
  while (!events_.empty() && !taken.would_hide(events_.front())) {
    taken.add(events_.front());
    frame.push_back(events_.front());
    events_.pop_front();
    if (!moves_focus(frame.back())) continue;
    frames_to_wait_ = kFramesToFocus;
    break;
  }
  return frame;
}

}  // namespace flytri::ui
