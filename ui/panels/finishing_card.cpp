/// @file  Progress of the finishing, time left, and cancel; or why it failed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/panels/panels.h"
#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

/// The part of the picture between the panels at its sides.
Rect room_between_sides(const PanelContext& context) {
  const float gap = context.px(kGapM);
  Rect room = context.layout.picture;
  room.x = colors_box(context).right() + gap;
  room.width = std::max(sides_box(context).x - gap - room.x, 0.0F);
  return room;
}

/// As wide as reads best, or as fits.
float card_width(const PanelContext& context) {
  return std::min(room_between_sides(context).width, context.px(440.0F));
}

/// In the middle of the scene, moved where it would cover a side panel.
Rect card_box(const PanelContext& context, float height) {
  const Rect room = room_between_sides(context);
  Rect box = context.layout.picture.centered(card_width(context), height);
  box.x = std::round(std::max(std::min(box.x, room.right() - box.width), room.x));
  return box;
}

void draw_progress(const PanelContext& context) {
  const scan::FinishingState& finishing = context.view.scan->finishing;
  const Rect box = card_box(context, context.px(172.0F));
  const Plate plate("finishing", box, overlay(context.theme));
  const Theme& theme = context.theme;
  Rect rest = box.inset(context.px(kGapL));
  const std::string_view step = finishing.stage.empty()
                                    ? context.text(Text::kStatusStarting)
                                    : context.view.texts.translated(finishing.stage);
  Rect head = rest.take_top(context.px(28.0F), context.px(kGapM));
  const std::string share = fmt::format("{:.0f} %", 100.0 * finishing.fraction);
  draw_text(head.take_right(context.px(72.0F)), {theme.fonts.title, kText, Align::kRight}, share);
  ImFont* font = fitting_font({theme.fonts.title, theme.fonts.strong}, head.width, step);
  draw_text(head, {font, kText, Align::kLeft}, step);
  meter(theme, rest.take_top(context.px(16.0F), context.px(kGapM)), finishing.fraction, kCaution);
  Rect row = rest.take_bottom(context.px(48.0F));
  const ActionLook cancel = {icon::kCancel, context.text(Text::kCancel)};
  const float width =
      std::max(small_action_width(context, Action::kCancel, cancel), context.px(144.0F));
  small_action(context, row.take_right(width, context.px(kGapM)), Action::kCancel, cancel);
  const std::string left = time_left_text(finishing.remaining_s, context.view.texts);
  font = fitting_font({theme.fonts.body, theme.fonts.small}, row.width, left);
  draw_text(row, {font, kTextQuiet, Align::kLeft}, left);
}

void draw_failure(const PanelContext& context) {
  const Theme& theme = context.theme;
  const float width = card_width(context), padding = context.px(kGapL);
  const std::string& text = context.view.scan->failure;
  const float text_height = wrapped_height(theme.fonts.body, width - 2.0F * padding, text);
  const float height = text_height + context.px(28.0F + kGapM) + 2.0F * padding;
  const Rect box = card_box(context, height);
  const Plate plate("failure", box, overlay(context.theme));
  Rect rest = box.inset(padding);
  const char* title = context.text(Text::kNotFinished);
  ImFont* font = fitting_font({theme.fonts.title, theme.fonts.strong}, rest.width, title);
  draw_text(rest.take_top(context.px(28.0F), context.px(kGapM)), {font, kText, Align::kLeft},
            title);
  draw_wrapped(rest, {theme.fonts.body, kTextQuiet}, text);
}

}  // namespace

void draw_finishing_card(const PanelContext& context) {
  if (context.view.scan == nullptr) return;
  if (context.phase() == scan::ScanPhase::kFinishing) {
    draw_progress(context);
  } else if (!context.view.scan->failure.empty() && !context.view.is_scanning) {
    draw_failure(context);
  }
}

}  // namespace flytri::ui
