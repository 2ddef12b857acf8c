/// @file  The list of keys: what each does, and whether it is possible now.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"

namespace flytri::ui {
namespace {

constexpr float kHelpRow = 23.0F;
constexpr float kHelpHeading = 30.0F;
constexpr float kKey = 84.0F;
/// Room for the longest name, and for the longest state.
constexpr float kName = 136.0F, kStateWidth = 124.0F;
constexpr std::size_t kPointerRows = 5;
/// The columns are about equally long; what the pointer does stands on top of the third.
constexpr std::array kFirstColumn = {ActionGroup::kScanning, ActionGroup::kLooking};
constexpr std::array kSecondColumn = {ActionGroup::kEditing, ActionGroup::kProgram};
constexpr std::array kThirdColumn = {ActionGroup::kCalibrating, ActionGroup::kHand};

/// The height that a column leaves for each of its rows.
float row_height(const PanelContext& context, float height, std::span<const ActionGroup> groups,
                 std::size_t more_rows) {
  std::size_t rows = more_rows;
  for (const ActionGroup group : groups) {
    const auto& all = rows_of(group);
    rows += static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [](const ActionRow& entry) { return entry.is_listed; }));
  }
  const std::size_t headings = groups.size() + (more_rows > 0 ? 1 : 0);
  const float heading = context.px(kHelpHeading) + context.px(kGapS);
  return std::floor((height - static_cast<float>(headings) * heading) / static_cast<float>(rows));
}

/// All rows have the same height, a lower one in a low window.
float row_height(const PanelContext& context, float height) {
  return std::min({context.px(kHelpRow), row_height(context, height, kFirstColumn, 0),
                   row_height(context, height, kSecondColumn, 0),
                   row_height(context, height, kThirdColumn, kPointerRows)});
}

void draw_row(const PanelContext& context, Rect row, const ActionRow& entry) {
  const Theme& theme = context.theme;
  const ActionState current = action_state(entry.action, context.view, context.state);
  const Color ink = current.is_enabled ? kText : with_opacity(kTextQuiet, 0.75F);
  draw_text(row.take_left(context.px(kKey), context.px(kGapS)), {theme.fonts.strong, ink},
            shortcut_text(entry.shortcut, context.view.texts));
  // In a small window both fit only in small letters, and a long name pushes its state aside.
  const bool is_narrow = row.width < context.px(kName + kStateWidth);
  ImFont* font = is_narrow ? theme.fonts.small : theme.fonts.body;
  const float gap = context.px(kGapS);
  const float name = std::max(text_width(font, context.text(entry.name)) + gap,
                              row.width - context.px(kStateWidth));
  draw_text(row.take_left(name), {font, ink}, context.text(entry.name));
  const Color mark = current.is_on ? kNeutral : kTextQuiet;
  draw_text(row, {theme.fonts.small, mark, Align::kLeft}, current.text);
}

void draw_group(const PanelContext& context, Rect& column, float row, ActionGroup group) {
  draw_text(column.take_top(context.px(kHelpHeading)),
            {context.theme.fonts.strong, kNeutral, Align::kLeft}, context.text(heading_of(group)));
  for (const ActionRow& entry : rows_of(group)) {
    if (entry.is_listed) draw_row(context, column.take_top(row), entry);
  }
  column.take_top(context.px(kGapS));
}

void draw_pointer(const PanelContext& context, Rect& column, float row_height_px) {
  constexpr std::array<std::array<Text, 2>, kPointerRows> kRows = {
      {{Text::kDrag, Text::kDragDoes},
       {Text::kRightDrag, Text::kRightDragDoes},
       {Text::kMiddleDrag, Text::kMiddleDragDoes},
       {Text::kDoubleClick, Text::kDoubleClickDoes},
       {Text::kWheel, Text::kWheelDoes}}};
  draw_text(column.take_top(context.px(kHelpHeading)),
            {context.theme.fonts.strong, kNeutral, Align::kLeft}, context.text(Text::kPointer));
  for (const auto& [what, does] : kRows) {
    Rect row = column.take_top(row_height_px);
    const Rect left = row.take_left(context.px(kKey), context.px(kGapS));
    const Fonts& fonts = context.theme.fonts;
    ImFont* font = fitting_font({fonts.strong, fonts.small}, left.width, context.text(what));
    draw_text(left, {font, kText}, context.text(what));
    font = fitting_font({fonts.body, fonts.small}, row.width, context.text(does));
    draw_text(row, {font, kText}, context.text(does));
  }
  column.take_top(context.px(kGapS));
}

}  // namespace

void draw_help_dialog(const PanelContext& context) {
  DialogPlate dialog(context, context.text(Text::kKeys), {1180.0F, 740.0F});
  const float gap = context.px(kGapL);
  const float width = (dialog.rest.width - 2.0F * gap) / 3.0F;
  Rect first = dialog.rest.take_left(width, gap);
  Rect second = dialog.rest.take_left(width, gap);
  Rect third = dialog.rest;
  const float row = row_height(context, dialog.rest.height);
  for (const ActionGroup group : kFirstColumn) draw_group(context, first, row, group);
  for (const ActionGroup group : kSecondColumn) draw_group(context, second, row, group);
  draw_pointer(context, third, row);
  for (const ActionGroup group : kThirdColumn) draw_group(context, third, row, group);
}

}  // namespace flytri::ui
