#include <GLFW/glfw3.h>

#include <optional>

#include "ui/actions/action_table.h"

namespace flytri::ui {
namespace {

/// The name of a key that shows a word.
std::optional<Text> word_on(int key) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return Text::kKeySpace;
    case GLFW_KEY_TAB:
      return Text::kKeyTab;
    case GLFW_KEY_BACKSPACE:
      return Text::kKeyBackspace;
    case GLFW_KEY_DELETE:
      return Text::kKeyDelete;
    case GLFW_KEY_ENTER:
      return Text::kKeyEnter;
    case GLFW_KEY_ESCAPE:
      return Text::kKeyEscape;
    case GLFW_KEY_HOME:
      return Text::kKeyHome;
    case GLFW_KEY_PAGE_UP:
      return Text::kKeyPageUp;
    case GLFW_KEY_PAGE_DOWN:
      return Text::kKeyPageDown;
    default:
      return std::nullopt;
  }
}

/// Letters, digits, signs, arrows and function keys.
std::string sign_on(int key) {
  switch (key) {
    case GLFW_KEY_LEFT:
      return "\u2190";
    case GLFW_KEY_UP:
      return "\u2191";
    case GLFW_KEY_RIGHT:
      return "\u2192";
    case GLFW_KEY_DOWN:
      return "\u2193";
    case GLFW_KEY_EQUAL:
      return "+";
    default:
      break;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return fmt::format("F{}", key - GLFW_KEY_F1 + 1);
  // Other keys have their character as number.
  return {static_cast<char>(key)};
}

}  // namespace

std::string shortcut_text(const Shortcut& shortcut, const Texts& texts) {
  std::string text;
  for (const auto& [modifier, name] : {std::pair{GLFW_MOD_CONTROL, Text::kKeyControl},
                                       std::pair{GLFW_MOD_SHIFT, Text::kKeyShift}}) {
    if ((shortcut.modifiers & modifier) != 0) text += std::string(texts[name]) + " ";
  }
  const auto word = word_on(shortcut.key);
  return text + (word ? std::string(texts[*word]) : sign_on(shortcut.key));
}

}  // namespace flytri::ui
