#include "ui/panels/review_parts.h"

#include <algorithm>

#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kRemovableRow = 36.0F, kReviewRow = 24.0F;

}  // namespace

bool removable(const PanelContext& context, Rect& rest, const RemovableRow& row) {
  Rect line = rest.take_top(context.px(kRemovableRow), context.px(kGapXs));
  ButtonLook look;
  look.id = row.id.c_str();
  look.icon = icon::kTrash;
  look.hint = context.text(row.hint);
  const Rect box = line.take_right(small_button_width(context.theme, look), context.px(kGapS));
  context.places.set(row.id, box);
  const bool is_clicked = small_button(context.theme, box, look);
  // In a narrow panel the number goes first.
  const float number = text_width(context.theme.fonts.strong, row.value);
  const float label = text_width(context.theme.fonts.body, row.label);
  const bool fits = number + label + context.px(kGapS) <= line.width;
  labeled_value(context.theme, line, fits ? row.label : "", row.value);
  return is_clicked;
}

std::size_t removable_rows(const PanelContext& context, const Rect& rest) {
  return static_cast<std::size_t>(
      std::max(0.0F, (rest.height + context.px(kGapXs)) / context.px(kRemovableRow + kGapXs)));
}

void value_row(const PanelContext& context, Rect& rest, Text label, const std::string& value) {
  const Theme& theme = context.theme;
  Rect row = rest.take_top(context.px(kReviewRow));
  const float width = text_width(theme.fonts.strong, value) + 1.0F;
  draw_text(row.take_right(width, context.px(kGapS)), {theme.fonts.strong, kText, Align::kRight},
            value);
  ImFont* font =
      fitting_font({theme.fonts.body, theme.fonts.small}, row.width, context.text(label));
  draw_text(row, {font, kTextQuiet, Align::kLeft}, context.text(label));
}

bool failure_text(const PanelContext& context, Rect& rest, Text headline,
                  const std::string& reason) {
  if (reason.empty()) return false;
  const Theme& theme = context.theme;
  const float height = draw_wrapped(rest, {theme.fonts.strong, kBad}, context.text(headline));
  rest.take_top(height, context.px(kGapXs));
  const std::string text = sentence(reason);
  rest.take_top(draw_wrapped(rest, {theme.fonts.small, kText}, text), context.px(kGapM));
  return true;
}

}  // namespace flytri::ui
