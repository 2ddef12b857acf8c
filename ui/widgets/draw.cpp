#include "ui/widgets/draw.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "ui/imgui/releases.h"
#include "ui/widgets/draw_record.h"

namespace flytri::ui {
namespace {

constexpr std::string_view kDots = "\xe2\x80\xa6";

const char* end_of(std::string_view text) { return text.data() + text.size(); }

/// A text may be larger than its box by this.
constexpr float kRounding_px = 1.0F;

ImVec2 size_of(ImFont* font, std::string_view text, float wrap_width = 0.0F) {
  return font->CalcTextSizeA(font_size_px(*font), FLT_MAX, wrap_width, text.data(), end_of(text));
}

/// Bytes that follow the first of a UTF-8 character.
bool goes_on(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// The text, cut to the width if needed.
template <typename Fits>
std::string shortened(std::string_view text, const Fits& fits) {
  if (fits(text)) return std::string(text);
  std::string shorter(text);
  while (!shorter.empty() && !fits(shorter + std::string(kDots))) {
    while (shorter.size() > 1 && goes_on(shorter.back())) shorter.pop_back();
    shorter.pop_back();
  }
  return shorter + std::string(kDots);
}

void note_cut(std::string_view text, const std::string& shown) {
  DrawRecord* record = draw_record();
  if (record != nullptr && shown != text) record->cut_texts.emplace_back(text);
}

/// Whether lines of this width hold each word as a whole, and all lines fit into the box.
bool fits_wrapped(const Rect& box, ImFont* font, std::string_view text) {
  if (size_of(font, text, box.width).y > box.height + kRounding_px) return false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    if (size_of(font, text.substr(0, end)).x > box.width + kRounding_px) return false;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return true;
}

float left_of(const Rect& box, Align align, float width) {
  switch (align) {
    case Align::kCenter:
      return std::round(box.x + (box.width - width) / 2.0F);
    case Align::kRight:
      return std::round(box.right() - width);
    case Align::kLeft:
      break;
  }
  return box.x;
}

}  // namespace

float text_width(ImFont* font, std::string_view text) { return size_of(font, text).x; }

float wrapped_height(ImFont* font, float width, std::string_view text) {
  return size_of(font, text, width).y;
}

std::string elided(ImFont* font, float width, std::string_view text) {
  return shortened(text, [&](std::string_view part) { return text_width(font, part) <= width; });
}

void draw_text(const Rect& box, const TextStyle& style, std::string_view text) {
  const std::string shown = elided(style.font, box.width, text);
  const float height = font_size_px(*style.font);
  note_cut(text, shown);
  if (draw_record() != nullptr && box.height + kRounding_px < height)
    draw_record()->cut_texts.emplace_back(text);
  const float width = text_width(style.font, shown);
  const ImVec2 at = {left_of(box, style.align, width),
                     std::round(box.y + (box.height - height) / 2.0F)};
  ImGui::GetWindowDrawList()->AddText(style.font, height, at, to_u32(style.color), shown.data(),
                                      end_of(shown));
}

ImFont* fitting_font(std::initializer_list<ImFont*> fonts, float width, std::string_view text) {
  return *std::find_if(fonts.begin(), fonts.end() - 1,
                       [&](ImFont* font) { return text_width(font, text) <= width; });
}

float draw_wrapped(const Rect& box, const TextStyle& style, std::string_view text) {
  if (draw_record() != nullptr && !fits_wrapped(box, style.font, text)) {
    draw_record()->cut_texts.emplace_back(text);
  }
  ImGui::GetWindowDrawList()->AddText(style.font, font_size_px(*style.font), box.min(),
                                      to_u32(style.color), text.data(), end_of(text), box.width);
  return wrapped_height(style.font, box.width, text);
}

void draw_fitted(const Rect& box, std::initializer_list<ImFont*> fonts, const Color& color,
                 std::string_view text) {
  const auto fits = [&](ImFont* font, std::string_view part) {
    return fits_wrapped(box, font, part);
  };
  const auto* chosen =
      std::find_if(fonts.begin(), fonts.end() - 1, [&](ImFont* font) { return fits(font, text); });
  const std::string shown =
      shortened(text, [&](std::string_view part) { return fits(*chosen, part); });
  note_cut(text, shown);
  const float height = wrapped_height(*chosen, box.width, shown);
  Rect lines = box;
  lines.y = std::round(box.y + (box.height - height) / 2.0F);
  draw_wrapped(lines, {*chosen, color}, shown);
}

std::string sentence(std::string message) {
  if (!message.empty() && message.front() >= 'a' && message.front() <= 'z')
    message.front() = static_cast<char>(message.front() - 'a' + 'A');
  return message;
}

void draw_box(const Rect& box, const Color& color, float rounding) {
  ImGui::GetWindowDrawList()->AddRectFilled(box.min(), box.max(), to_u32(color), rounding);
}

void draw_outline(const Rect& box, const Color& color, float thickness, float rounding) {
  // ImGui centers lines: half of the thickness goes inside.
  const Rect middle = box.inset(thickness / 2.0F);
  ImGui::GetWindowDrawList()->AddRect(middle.min(), middle.max(), to_u32(color), rounding, 0,
                                      thickness);
}

bool touch_area(const char* id, const Rect& box, ImGuiButtonFlags buttons) {
  ImGui::SetCursorScreenPos(box.min());
  // In a tiny window a box may be empty, which Dear ImGui does not allow.
  return ImGui::InvisibleButton(id, {std::max(box.width, 1.0F), std::max(box.height, 1.0F)},
                                buttons);
}

}  // namespace flytri::ui
