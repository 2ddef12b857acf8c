#include "ui/window/input.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

KeyEvent press(int key) { return {key, 0, true, false}; }
KeyEvent release(int key) { return {key, 0, false, false}; }

TEST(InputQueue, PressAndReleaseOfAKeyComeInTwoFrames) {
  InputQueue queue;
  queue.push(press('A'));
  queue.push(release('A'));
  ASSERT_EQ(queue.take_frame().size(), 1U);
  const auto second = queue.take_frame();
  ASSERT_EQ(second.size(), 1U);
  EXPECT_FALSE(std::get<KeyEvent>(second.front()).is_down);
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, TypedTextWaitsUntilTabHasMovedTheFocus) {
  InputQueue queue;
  queue.push(KeyEvent{GLFW_KEY_TAB, 0, true});
  queue.push(CharacterEvent{'2'});
  EXPECT_EQ(queue.take_frame().size(), 1U);
  EXPECT_TRUE(queue.take_frame().empty());
  EXPECT_TRUE(queue.take_frame().empty());
  EXPECT_EQ(queue.take_frame().size(), 1U);
}

TEST(InputQueue, DifferentKeysComeTogether) {
  InputQueue queue;
  queue.push(press('A'));
  queue.push(press('B'));
  EXPECT_EQ(queue.take_frame().size(), 2U);
}

TEST(InputQueue, AClickStaysInItsPlace) {
  InputQueue queue;
  queue.push(PointerEvent{10.0F, 10.0F});
  queue.push(ButtonEvent{0, true});
  queue.push(PointerEvent{90.0F, 90.0F});
  queue.push(ButtonEvent{0, false});
  EXPECT_EQ(queue.take_frame().size(), 2U) << "to the place, and pressed";
  EXPECT_EQ(queue.take_frame().size(), 2U) << "dragged, and let go";
}

TEST(InputQueue, SlowFramesLoseNoEvents) {
  InputQueue queue;
  constexpr int kClicks = 100;
  for (int i = 0; i < kClicks; ++i) {
    queue.push(ButtonEvent{0, true});
    queue.push(ButtonEvent{0, false});
    queue.push(press(' '));
    queue.push(release(' '));
  }
  int buttons = 0, keys = 0;
  while (!queue.empty()) {
    for (const InputEvent& event : queue.take_frame()) {
      buttons += static_cast<int>(std::holds_alternative<ButtonEvent>(event));
      keys += static_cast<int>(std::holds_alternative<KeyEvent>(event));
    }
  }
  EXPECT_EQ(buttons, 2 * kClicks);
  EXPECT_EQ(keys, 2 * kClicks);
}

}  // namespace
}  // namespace flytri::ui
