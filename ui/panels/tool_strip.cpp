/// @file  How to use the chosen tool, and the size of its brush.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ui/panels/panels.h"
#include "ui/state/review_look.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kHeight = 60.0F;
constexpr float kToolButton = 44.0F;

Text review_instruction(const WindowState& state) {
  switch (state.review.mode) {
    case ReviewMode::kAngle:
      return Text::kClickAngle;
    case ReviewMode::kSection:
      return Text::kClickSection;
    case ReviewMode::kUndercut:
      return Text::kClickPrepared;
    case ReviewMode::kMargin:
      return Text::kClickMargin;
    case ReviewMode::kDistance:
      break;
  }
  return state.measured_from_mm ? Text::kClickSecondPoint : Text::kClickFirstPoint;
}

std::optional<Text> instruction(const AppView& view, const WindowState& state) {
  if (is_reviewing(view, state)) return review_instruction(state);
  switch (state.tool) {
    case Tool::kTrim:
      return Text::kPaintToRemove;
    case Tool::kLock:
      return Text::kPaintToLock;
    case Tool::kUnlock:
      return Text::kPaintToUnlock;
    case Tool::kMeasure:
      return state.measured_from_mm ? Text::kClickSecondPoint : Text::kClickFirstPoint;
    case Tool::kNone:
      break;
  }
  return std::nullopt;
}

void draw_brush_size(const PanelContext& context, Rect& row) {
  const float side = context.px(kToolButton);
  small_action(context, row.take_right(side, context.px(kGapXs)), Action::kBrushLarger,
               {nullptr, "+", false, kNeutral, false});
  const double diameter_mm = 2.0 * context.state.brush.radius_share * context.view.volume_mm.x();
  draw_text(row.take_right(context.px(76.0F), context.px(kGapXs)),
            {context.theme.fonts.strong, kText, Align::kCenter},
            fmt::format("{:.1f} mm", diameter_mm));
  small_action(context, row.take_right(side, context.px(kGapM)), Action::kBrushSmaller,
               {nullptr, "\u2212", false, kNeutral, false});
}

ActionLook clear_look(const PanelContext& context) {
  return {nullptr, context.text(Text::kClearAll), false, kNeutral, false};
}

float clear_width(const PanelContext& context) {
  return small_action_width(context, Action::kClearStage, clear_look(context));
}

ActionLook done_look(const PanelContext& context) {
  return {nullptr, context.text(Text::kToolDone)};
}

float done_width(const PanelContext& context) {
  return std::max(small_action_width(context, Action::kCancel, done_look(context)),
                  context.px(96.0F));
}

/// @param has_clear  with the button that clears the stage
float strip_width(const PanelContext& context, const char* text, bool has_clear) {
  const float brush = has_brush(context.state.tool)
                          ? context.px(2.0F * kToolButton + 76.0F + 2.0F * kGapXs + kGapM)
                          : 0.0F;
  // Rounding must not send the last word to a line of its own.
  const float clear = has_clear ? clear_width(context) + context.px(kGapM) : 0.0F;
  const float line = std::ceil(text_width(context.theme.fonts.body, text)) + context.px(kGapXs);
  return line + brush + clear + done_width(context) + 3.0F * context.px(kGapM);
}

/// Whether the button "Clear all" fits beside the text. The text may take two lines.
bool has_room_to_clear(const PanelContext& context, const char* text, float width) {
  const float room = width - strip_width(context, "", true);
  const float height = context.px(kHeight - 2.0F * kGapS);
  return room > 0.0F && wrapped_height(context.theme.fonts.small, room, text) <= height;
}

}  // namespace

void draw_tool_strip(const PanelContext& context) {
  const auto to_do = instruction(context.view, context.state);
  if (!to_do) return;
  const char* text = context.text(*to_do);
  const Rect& picture = context.layout.picture;
  const float margin = context.px(kGapM);
  // To the right of the findings panel.
  const auto findings = findings_box(context);
  const float left = (findings ? findings->right() : picture.x) + margin;
  const float right = picture.right() - margin;
  // In the narrowest windows the key alone clears the stage.
  const bool has_clear =
      context.state.tool == Tool::kTrim && has_room_to_clear(context, text, right - left);
  const float width = std::round(std::min(strip_width(context, text, has_clear), right - left));
  const float height = context.px(kHeight);
  const float middle = std::round(picture.center().x - width / 2.0F);
  const Rect box = {std::max(middle, left), picture.bottom() - margin - height, width, height};
  const Plate plate("tool", box, overlay(context.theme));
  Rect row = box.inset(context.px(kGapM), context.px(kGapS));
  small_action(context, row.take_right(done_width(context), context.px(kGapM)), Action::kCancel,
               done_look(context));
  if (has_clear) {
    small_action(context, row.take_right(clear_width(context), context.px(kGapM)),
                 Action::kClearStage, clear_look(context));
  }
  if (has_brush(context.state.tool)) draw_brush_size(context, row);
  // In two lines where one is too long.
  draw_fitted(row, {context.theme.fonts.body, context.theme.fonts.small}, kText, text);
}

}  // namespace flytri::ui
