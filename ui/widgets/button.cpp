#include "ui/widgets/button.h"

#include "ui/imgui/releases.h"
#include "ui/widgets/hint.h"

namespace flytri::ui {
namespace {

/// Beside what stands in a small button; the second where there is little room.
constexpr float kMargin = 12.0F, kNarrowMargin = 6.0F;

/// What the pointer does with a button.
struct Touch {
  bool is_clicked = false, is_hovered = false, is_held = false;
};

Touch touch(const Rect& box, const ButtonLook& look) {
  const bool is_clicked = touch_area(look.id, box) && look.is_enabled;
  const bool is_hovered = ImGui::IsItemHovered();
  hint_over_item(look.hint);
  return {is_clicked, is_hovered && look.is_enabled, ImGui::IsItemActive() && look.is_enabled};
}

Color face_color(const ButtonLook& look, const Touch& touched) {
  if (!look.is_enabled) return with_opacity(kRaised, 0.45F);
  const Color base =
      look.is_main ? look.color : (look.is_on ? mix(kRaised, look.color, 0.28F) : kRaised);
  if (touched.is_held) return mix(base, kText, 0.22F);
  if (touched.is_hovered) return mix(base, kText, 0.10F);
  return base;
}

Color ink_color(const ButtonLook& look) {
  if (!look.is_enabled) return with_opacity(kTextQuiet, 0.5F);
  return look.is_main ? kTextOnColor : kText;
}

/// Fills the button; one that is on also gets an outline, not only a color.
Touch draw_face(const Theme& theme, const Rect& box, const ButtonLook& look) {
  const Touch touched = touch(box, look);
  const float rounding = theme.px(kRounding);
  draw_box(box, face_color(look, touched), rounding);
  if (look.is_on && !look.is_main) draw_outline(box, look.color, theme.px(2.0F), rounding);
  return touched;
}

Color key_color(const ButtonLook& look) {
  if (!look.is_enabled) return with_opacity(kTextQuiet, 0.5F);
  return look.is_main ? with_opacity(kTextOnColor, 0.75F) : kTextQuiet;
}

void draw_key(const Theme& theme, const Rect& box, const ButtonLook& look) {
  if (look.key.empty()) return;
  Rect corner = box.inset(theme.px(kGapS), theme.px(6.0F));
  corner = corner.take_top(font_size_px(*theme.fonts.small));
  draw_text(corner, {theme.fonts.small, key_color(look), Align::kRight}, look.key);
}

}  // namespace

bool large_button(const Theme& theme, const Rect& box, const ButtonLook& look) {
  const Touch touched = draw_face(theme, box, look);
  const Color ink = ink_color(look);
  const float icon_height = font_size_px(*theme.fonts.icon);
  const float label_height = font_size_px(*theme.fonts.strong);
  const float gap = theme.px(6.0F);
  Rect middle = box.centered(box.width - theme.px(kGapS), icon_height + gap + label_height);
  draw_text(middle.take_top(icon_height, gap), {theme.fonts.icon, ink, Align::kCenter}, look.icon);
  ImFont* font = fitting_font({theme.fonts.strong, theme.fonts.small}, middle.width, look.label);
  draw_text(middle, {font, ink, Align::kCenter}, look.label);
  draw_key(theme, box, look);
  return touched.is_clicked;
}

float small_button_width(const Theme& theme, const ButtonLook& look) {
  float width = 2.0F * theme.px(kMargin);
  if (look.icon != nullptr) width += text_width(theme.fonts.strong, look.icon);
  if (look.icon != nullptr && !look.label.empty()) width += theme.px(kGapS);
  width += text_width(theme.fonts.strong, look.label);
  if (!look.key.empty()) width += theme.px(kGapS) + text_width(theme.fonts.small, look.key);
  return width;
}

bool small_button(const Theme& theme, const Rect& box, const ButtonLook& look) {
  const Touch touched = draw_face(theme, box, look);
  const Color ink = ink_color(look);
  const float content = std::min(small_button_width(theme, look) - 2.0F * theme.px(kMargin),
                                 box.width - 2.0F * theme.px(kNarrowMargin));
  Rect row = box.centered(content, box.height);
  if (look.icon != nullptr) {
    const float width = text_width(theme.fonts.strong, look.icon);
    draw_text(row.take_left(width, theme.px(kGapS)), {theme.fonts.strong, ink, Align::kLeft},
              look.icon);
  }
  if (!look.key.empty()) {
    const Color quiet = key_color(look);
    const float width = text_width(theme.fonts.small, look.key);
    draw_text(row.take_right(width, theme.px(kGapS)), {theme.fonts.small, quiet, Align::kRight},
              look.key);
  }
  // Widths are sums of rounded ones.
  row.width += 1.0F;
  ImFont* font = fitting_font({theme.fonts.strong, theme.fonts.small}, row.width, look.label);
  const bool is_small = font != theme.fonts.strong;
  draw_text(row, {font, ink, is_small ? Align::kCenter : Align::kLeft}, look.label);
  return touched.is_clicked;
}

}  // namespace flytri::ui
