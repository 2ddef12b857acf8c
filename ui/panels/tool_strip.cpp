/// @file  How to use the chosen tool, and the size of its brush.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

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

/// Empty without a tool.
std::string instruction(const PanelContext& context) {
  const WindowState& state = context.state;
  if (is_reviewing(context.view, state)) return context.text(review_instruction(state));
  switch (state.tool) {
    case Tool::kTrim:
      return context.text(Text::kPaintToRemove);
    case Tool::kLock:
      return context.text(Text::kPaintToLock);
    case Tool::kUnlock:
      return context.text(Text::kPaintToUnlock);
    case Tool::kMeasure:
      return context.text(state.measured_from_mm ? Text::kClickSecondPoint
                                                 : Text::kClickFirstPoint);
    case Tool::kPlane:
      if (!context.view.plane) return context.text(Text::kPlaneIsSought);
      return context.view.texts.fill<Text::kClickPlane>(state.plane_points_mm.size() + 1);
    case Tool::kNone:
      break;
  }
  return {};
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

/// The button that takes back what the tool has done as a whole.
struct ResetButton {
  Action action;
  ActionLook look;
};

std::optional<ResetButton> reset_button(const PanelContext& context) {
  const auto named = [&](Action action, Text name) {
    return ResetButton{action, {nullptr, context.text(name), false, kNeutral, false}};
  };
  if (context.state.tool == Tool::kTrim) return named(Action::kClearStage, Text::kClearAll);
  if (context.state.tool == Tool::kPlane) return named(Action::kAutomaticPlane, Text::kAutomatic);
  return std::nullopt;
}

float reset_width(const PanelContext& context, const std::optional<ResetButton>& reset) {
  if (!reset) return 0.0F;
  return small_action_width(context, reset->action, reset->look) + context.px(kGapM);
}

ActionLook done_look(const PanelContext& context) {
  return {nullptr, context.text(Text::kToolDone)};
}

float done_width(const PanelContext& context) {
  return std::max(small_action_width(context, Action::kCancel, done_look(context)),
                  context.px(96.0F));
}

float strip_width(const PanelContext& context, const std::string& text,
                  const std::optional<ResetButton>& reset) {
  const float brush = has_brush(context.state.tool)
                          ? context.px(2.0F * kToolButton + 76.0F + 2.0F * kGapXs + kGapM)
                          : 0.0F;
  // Rounding must not send the last word to a line of its own.
  const float line = std::ceil(text_width(context.theme.fonts.body, text)) + context.px(kGapXs);
  return line + brush + reset_width(context, reset) + done_width(context) +
         3.0F * context.px(kGapM);
}

/// Whether the button fits beside the text. The text may take two lines.
bool has_room(const PanelContext& context, const std::string& text,
              const std::optional<ResetButton>& reset, float width) {
  const float room = width - strip_width(context, "", reset);
  const float height = context.px(kHeight - 2.0F * kGapS);
  return room > 0.0F && wrapped_height(context.theme.fonts.small, room, text) <= height;
}

}  // namespace

void draw_tool_strip(const PanelContext& context) {
  const std::string text = instruction(context);
  if (text.empty()) return;
  const Rect& picture = context.layout.picture;
  const float margin = context.px(kGapM);
  // To the right of the findings panel.
  const auto findings = findings_box(context);
  const float left = (findings ? findings->right() : picture.x) + margin;
  const float right = picture.right() - margin;
  // In the narrowest windows the key alone does it.
  std::optional<ResetButton> reset = reset_button(context);
  if (!has_room(context, text, reset, right - left)) reset.reset();
  const float width = std::round(std::min(strip_width(context, text, reset), right - left));
  const float height = context.px(kHeight);
  const float middle = std::round(picture.center().x - width / 2.0F);
  const Rect box = {std::max(middle, left), picture.bottom() - margin - height, width, height};
  const Plate plate("tool", box, overlay(context.theme));
  Rect row = box.inset(context.px(kGapM), context.px(kGapS));
  small_action(context, row.take_right(done_width(context), context.px(kGapM)), Action::kCancel,
               done_look(context));
  if (reset) {
    const float reset_px = small_action_width(context, reset->action, reset->look);
    small_action(context, row.take_right(reset_px, context.px(kGapM)), reset->action, reset->look);
  }
  if (has_brush(context.state.tool)) draw_brush_size(context, row);
  // The scan was finished again: another plane.
  if (context.state.tool == Tool::kPlane && !context.view.plane)
    context.commands.emplace_back(FindOcclusalPlane{});
  // In two lines where one is too long.
  draw_fitted(row, {context.theme.fonts.body, context.theme.fonts.small}, kText, text);
}

}  // namespace flytri::ui
