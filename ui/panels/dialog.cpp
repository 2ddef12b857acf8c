#include "ui/panels/dialog.h"

#include <imgui_stdlib.h>

#include <cmath>

#include "ui/theme/icons.h"
#include "ui/widgets/typed_text.h"

namespace flytri::ui {
namespace {

constexpr float kTitle = 32.0F;
constexpr float kButton = 48.0F;

Rect dialog_box(const PanelContext& context, const ImVec2& size) {
  const Rect room = context.layout.window.inset(context.px(kGapL));
  const Rect box = room.centered(std::min(context.px(size.x), room.width),
                                 std::min(context.px(size.y), room.height));
  return {std::round(box.x), std::round(box.y), box.width, box.height};
}

/// A click beside the dialog closes it, unless the press began on it.
void close_by_click(const PanelContext& context, const Rect& box) {
  if (ImGui::IsMouseClicked(0) && !box.contains(ImGui::GetIO().MousePos)) {
    perform(Action::kCancel, context.view, context.state, context.commands);
  }
}

void draw_close(const PanelContext& context, const Rect& box) {
  ButtonLook look;
  look.id = "close";
  look.icon = icon::kCancel;
  look.hint = context.view.texts.fill<Text::kCloseHint>(context.text(Text::kKeyEscape));
  context.places.set(look.id, box);
  if (small_button(context.theme, box, look)) {
    perform(Action::kCancel, context.view, context.state, context.commands);
  }
}

/// Draws the label, and makes place for the text below. @return  the id of the text's item
std::string begin_text_field(const PanelContext& context, Rect row, const TextFieldLook& look) {
  draw_text(row.take_top(context.px(18.0F), context.px(kGapXs)),
            {context.theme.fonts.small, kTextQuiet, Align::kLeft}, look.label);
  ImGui::SetCursorScreenPos(row.min());
  ImGui::SetNextItemWidth(row.width);
  context.places.set(look.id, {row.x, row.y, row.width, context.px(36.0F)});
  if (look.takes_focus) ImGui::SetKeyboardFocusHere();
  return std::string("##") + look.id;
}

}  // namespace

DialogPlate::DialogPlate(const PanelContext& context, const char* title, const ImVec2& size,
                         ClickBeside beside)
    : plate_("dialog", context.layout.window, {Layer::kDialog, kShade, 0.0F}) {
  const Rect box = dialog_box(context, size);
  context.places.set("dialog", box);
  draw_box(box, kPanel, context.px(12.0F));
  draw_outline(box, kHairline, context.px(1.0F), context.px(12.0F));
  if (beside == ClickBeside::kCloses) close_by_click(context, box);
  rest = box.inset(context.px(kGapL));
  Rect head = rest.take_top(context.px(kTitle), context.px(kGapM));
  draw_close(context, head.take_right(context.px(40.0F)).inset(0.0F, context.px(-4.0F)));
  draw_text(head, {context.theme.fonts.title, kText, Align::kLeft}, title);
}

bool text_field(const PanelContext& context, Rect row, const TextFieldLook& look,
                std::string& text) {
  return ImGui::InputText(begin_text_field(context, row, look).c_str(), &text);
}

bool text_field(const PanelContext& context, Rect row, const TextFieldLook& look, Secret& text) {
  return secret_input(begin_text_field(context, row, look).c_str(), text);
}

bool path_field(const PanelContext& context, Rect row, const TextFieldLook& look, PathField field,
                std::string& text) {
  const std::string id = std::string(look.id) + "_choose";
  const ChooserState& chooser = context.view.chooser;
  ButtonLook button;
  button.id = id.c_str();
  button.label = "\u2026";
  button.is_enabled = chooser.why_not.empty() && !chooser.is_open;
  button.hint = chooser.why_not.empty()
                    ? context.text(Text::kChooseOnComputer)
                    : std::string(context.view.texts.translated(chooser.why_not));
  Rect side = row;
  side = side.take_right(context.px(44.0F));
  side.take_top(context.px(18.0F), context.px(kGapXs));
  const Rect box = side.take_top(context.px(36.0F));
  context.places.set(id, box);
  if (small_button(context.theme, box, button)) {
    context.commands.emplace_back(ChoosePath{field, text});
  }
  row.take_right(context.px(44.0F), context.px(kGapXs));
  return text_field(context, row, look, text);
}

bool tick_box(const PanelContext& context, const Rect& row, const TickLook& look, bool& is_ticked) {
  ButtonLook button;
  button.id = look.id;
  button.icon = is_ticked ? icon::kFinish : nullptr;
  button.label = look.label;
  button.is_on = is_ticked && look.is_enabled;
  button.is_enabled = look.is_enabled;
  context.places.set(look.id, row);
  if (!small_button(context.theme, row, button)) return false;
  is_ticked = !is_ticked;
  return true;
}

Rect confirm_row(const PanelContext& context, DialogPlate& dialog, const char* icon,
                 const char* label) {
  Rect row = dialog.rest.take_bottom(context.px(kButton), context.px(kGapM));
  const ActionLook look = {icon, label, true, kNeutral};
  const float width =
      std::max(small_action_width(context, Action::kConfirm, look), context.px(160.0F));
  small_action(context, row.take_right(width, context.px(kGapS)), Action::kConfirm, look);
  return row;
}

}  // namespace flytri::ui
