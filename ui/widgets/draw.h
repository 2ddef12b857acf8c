/// @file  Text and boxes as every widget draws them.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "ui/theme/palette.h"
#include "ui/theme/theme.h"
#include "ui/widgets/rect.h"

namespace flytri::ui {

enum class Align { kLeft, kCenter, kRight };

/// A font and a color.
struct TextStyle {
  ImFont* font = nullptr;
  Color color = kText;
  Align align = Align::kLeft;
};

/// One line of text in the vertical middle of `box`, cut short with dots where it is too long.
void draw_text(const Rect& box, const TextStyle& style, std::string_view text);
/// Text that goes over several lines, from the top of `box`. @return  its height
float draw_wrapped(const Rect& box, const TextStyle& style, std::string_view text);
/// Text in the vertical middle of `box`, over as many lines as it takes, in the first of the fonts
/// in which it has room; where the last is too large for it, too, cut short with dots.
void draw_fitted(const Rect& box, std::initializer_list<ImFont*> fonts, const Color& color,
                 std::string_view text);
[[nodiscard]] float text_width(ImFont* font, std::string_view text);
[[nodiscard]] float wrapped_height(ImFont* font, float width, std::string_view text);
/// The text, or as much of it as goes into the width with dots after it.
[[nodiscard]] std::string elided(ImFont* font, float width, std::string_view text);

/// Messages of the devices begin small, as they often follow the name of a file; in a paragraph of
/// their own they begin large.
[[nodiscard]] std::string sentence(std::string message);

/// A filled box with round corners.
void draw_box(const Rect& box, const Color& color, float rounding = 0.0F);
void draw_outline(const Rect& box, const Color& color, float thickness, float rounding = 0.0F);

/// Takes clicks and drags within a box, which Dear ImGui then speaks of as its last item.
/// @param id  unique in its panel
/// @return  whether it was clicked
bool touch_area(const char* id, const Rect& box,
                ImGuiButtonFlags buttons = ImGuiButtonFlags_MouseButtonLeft);

}  // namespace flytri::ui
