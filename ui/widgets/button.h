/// @file  Buttons for gloved fingers: large, with icon, label and key.
#pragma once

#include <string>

#include "ui/widgets/draw.h"

namespace flytri::ui {

/// Texts and state of a button.
struct ButtonLook {
  const char* id = "";  ///< unique in its panel
  const char* icon = nullptr;
  std::string label;
  std::string key;  ///< its key, small in the corner; empty: not shown
  bool is_enabled = true;
  bool is_on = false;      ///< chosen
  bool is_main = false;    ///< filled with `color`: the suggested next step
  Color color = kNeutral;  ///< if it is on or main
  std::string hint;        ///< shown when the pointer rests on it
};

/// Icon above the label, the key in the upper right corner. @return  true when clicked
bool large_button(const Theme& theme, const Rect& box, const ButtonLook& look);
/// Icon, if there is one, and label in a row. @return  true when clicked
bool small_button(const Theme& theme, const Rect& box, const ButtonLook& look);
/// Width that a small button needs for its text.
[[nodiscard]] float small_button_width(const Theme& theme, const ButtonLook& look);

}  // namespace flytri::ui
