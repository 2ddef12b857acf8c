#include "ui/widgets/badge.h"

#include <cmath>

namespace flytri::ui {

float badge(const Theme& theme, const Rect& box, const BadgeLook& look, ImFont* font) {
  const float padding = std::round(box.height * 0.4F);
  const float gap = look.icon == nullptr ? 0.0F : theme.px(kGapS);
  const float icon_width = look.icon == nullptr ? 0.0F : text_width(font, look.icon);
  const float width = 2.0F * padding + icon_width + gap + text_width(font, look.text);
  draw_box({box.x, box.y, width, box.height}, look.color, theme.px(kRounding));
  Rect row = {box.x + padding, box.y, width - 2.0F * padding, box.height};
  if (look.icon != nullptr) {
    draw_text(row.take_left(icon_width, gap), {font, kTextOnColor, Align::kLeft}, look.icon);
  }
  row.width += 1.0F;  // Rounding must not cut the text.
  draw_text(row, {font, kTextOnColor, Align::kLeft}, look.text);
  return width;
}

float legend(const Theme& theme, const Rect& box, std::span<const LegendRow> rows) {
  Rect rest = box;
  const float height = theme.px(20.0F), side = theme.px(14.0F), gap = theme.px(kGapXs);
  for (const LegendRow& entry : rows) {
    Rect row = rest.take_top(height, gap);
    const Rect swatch = row.take_left(side, theme.px(kGapS)).centered(side, side);
    if (entry.is_hollow) {
      draw_outline(swatch, entry.color, theme.px(2.0F), theme.px(3.0F));
    } else {
      draw_box(swatch, entry.color, theme.px(3.0F));
    }
    draw_text(row, {theme.fonts.body, kText, Align::kLeft}, entry.text);
  }
  return (height + gap) * static_cast<float>(rows.size()) - gap;
}

float color_scale(const Theme& theme, const Rect& box, const ScaleLook& look) {
  Rect rest = box;
  const Rect bar = rest.take_top(theme.px(12.0F), theme.px(kGapXs));
  const float step = bar.width / static_cast<float>(look.colors.size() - 1);
  for (std::size_t i = 0; i + 1 < look.colors.size(); ++i) {
    const ImU32 left = to_u32(look.colors[i]), right = to_u32(look.colors[i + 1]);
    const float x = bar.x + step * static_cast<float>(i);
    ImGui::GetWindowDrawList()->AddRectFilledMultiColor({x, bar.y}, {x + step, bar.bottom()}, left,
                                                        right, right, left);
  }
  const Rect row = rest.take_top(theme.px(18.0F));
  draw_text(row, {theme.fonts.small, kText, Align::kLeft}, look.low);
  draw_text(row, {theme.fonts.small, kText, Align::kCenter}, look.middle);
  draw_text(row, {theme.fonts.small, kText, Align::kRight}, look.high);
  return theme.px(34.0F);
}

}  // namespace flytri::ui
