/// @file  Draws text and boxes for all widgets.
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

/// One line of text in the vertical middle of `box`; a long text is cut and ends with "…".
void draw_text(const Rect& box, const TextStyle& style, std::string_view text);
/// The first of the fonts in which the text fits into one line of this width, else the last.
[[nodiscard]] ImFont* fitting_font(std::initializer_list<ImFont*> fonts, float width,
                                   std::string_view text);
/// Text in several lines, from the top of `box`. @return  its height
float draw_wrapped(const Rect& box, const TextStyle& style, std::string_view text);
/// Text in several lines in the vertical middle of `box`, in the first of the fonts in which it
/// fits. If none fits, it is cut and ends with "…".
void draw_fitted(const Rect& box, std::initializer_list<ImFont*> fonts, const Color& color,
                 std::string_view text);
[[nodiscard]] float text_width(ImFont* font, std::string_view text);
[[nodiscard]] float wrapped_height(ImFont* font, float width, std::string_view text);
/// The text, cut to the width if needed; then it ends with "…".
[[nodiscard]] std::string elided(ImFont* font, float width, std::string_view text);

/// The text with a capital first letter: messages of devices start small, as they often follow a
/// file name.
[[nodiscard]] std::string sentence(std::string message);

/// A filled box with round corners.
void draw_box(const Rect& box, const Color& color, float rounding = 0.0F);
void draw_outline(const Rect& box, const Color& color, float thickness, float rounding = 0.0F);

/// Takes clicks and drags within a box, which becomes the last item of Dear ImGui.
/// @param id  unique in its panel
/// @return  whether it was clicked
bool touch_area(const char* id, const Rect& box,
                ImGuiButtonFlags buttons = ImGuiButtonFlags_MouseButtonLeft);

}  // namespace flytri::ui
