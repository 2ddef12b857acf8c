/// @file  A text beside the pointer, while it rests on a part of the window.
#pragma once

#include <string>

#include "ui/widgets/draw.h"

namespace flytri::ui {

/// Shows `text` while the pointer is over `box` and nothing covers it. Long texts are wrapped.
void hint_over(const Rect& box, const std::string& text);

/// The same for the item that was drawn last.
void hint_over_item(const std::string& text);

}  // namespace flytri::ui
