#include "ui/panels/panel.h"

#include "ui/widgets/draw_record.h"

namespace flytri::ui {
namespace {

/// What the button does not show itself: name, key and state.
std::string hint_of(const Texts& texts, const ActionRow& row, const ActionState& current,
                    const ButtonLook& button) {
  const bool shows_name = button.label == texts[row.name];
  std::string hint = shows_name ? "" : texts[row.name];
  if (button.key.empty()) {
    const std::string key = shortcut_text(row.shortcut, texts);
    hint =
        shows_name ? texts.fill<Text::kHintKey>(key) : texts.fill<Text::kHintNameAndKey>(hint, key);
  }
  if (!current.text.empty()) hint += (hint.empty() ? "" : ". ") + sentence(current.text);
  return hint;
}

ButtonLook look_of(const PanelContext& context, Action action, const ActionLook& look) {
  const ActionRow& row = row_of(action);
  const ActionState current = action_state(action, context.view, context.state);
  ButtonLook button;
  button.id = row.id;
  button.icon = look.icon;
  button.label = look.label == nullptr ? context.text(row.name) : look.label;
  if (look.shows_key) button.key = shortcut_text(row.shortcut, context.view.texts);
  button.is_enabled = current.is_enabled;
  button.is_on = current.is_on;
  button.is_main = look.is_main;
  button.color = look.color;
  button.hint = hint_of(context.view.texts, row, current, button);
  return button;
}

constexpr ImGuiWindowFlags kPlain =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

ImGuiWindowFlags flags_of(Layer layer) {
  switch (layer) {
    case Layer::kFixed:
      return ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;
    case Layer::kOver:
      return ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    case Layer::kDialog:
      break;  // Tab moves between the fields of a dialog.
  }
  return ImGuiWindowFlags_None;
}

}  // namespace

PlateLook overlay(const Theme& theme) {
  return {Layer::kOver, with_opacity(kPanel, 0.92F), theme.px(kRounding)};
}

Plate::Plate(const char* id, const Rect& box, const PlateLook& look) {
  ImGui::SetNextWindowPos(box.min());
  ImGui::SetNextWindowSize(box.size());
  // Focus brings a window to the front, whatever was clicked before.
  if (look.layer == Layer::kDialog) ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, look.rounding_px);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, to_vec4(look.color));
  ImGui::Begin(id, nullptr, kPlain | flags_of(look.layer));
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  DrawRecord* record = draw_record();
  if (record != nullptr && look.layer == Layer::kOver) record->overlays.push_back({id, box});
}

Plate::~Plate() { ImGui::End(); }

void large_action(const PanelContext& context, const Rect& box, Action action,
                  const ActionLook& look) {
  context.places.set(row_of(action).id, box);
  if (large_button(context.theme, box, look_of(context, action, look))) {
    perform(action, context.view, context.state, context.commands);
  }
}

void small_action(const PanelContext& context, const Rect& box, Action action,
                  const ActionLook& look) {
  context.places.set(row_of(action).id, box);
  if (small_button(context.theme, box, look_of(context, action, look))) {
    perform(action, context.view, context.state, context.commands);
  }
}

float small_action_width(const PanelContext& context, Action action, const ActionLook& look) {
  return small_button_width(context.theme, look_of(context, action, look));
}

Rect show_camera_image(const PanelContext& context, const Rect& box, const CameraPicture& picture,
                       const char* missing_text) {
  const Rect image = camera_image(context.theme, box, picture, missing_text);
  if (picture.is_new) context.repainted.push_back(image);
  return image;
}

}  // namespace flytri::ui
