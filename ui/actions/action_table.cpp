#include "ui/actions/action_table.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

#include "ui/actions/action_groups.h"

namespace flytri::ui {
namespace {

struct GroupRows {
  Text heading;
  std::span<const ActionRow> (*rows)();
};
/// In the order of ActionGroup.
constexpr std::array<GroupRows, kFirstOfGroup.size() - 1> kGroups = {
    {{Text::kGroupScanning, scanning_actions},
     {Text::kGroupEditing, editing_actions},
     {Text::kGroupView, looking_actions},
     {Text::kGroupHand, hand_actions},
     {Text::kGroupCalibration, calibrating_actions},
     {Text::kGroupProgram, program_actions}}};

/// Each group's file lists all of its actions in order, so that Action is the index.
std::vector<ActionRow> join_groups() {
  std::vector<ActionRow> table;
  for (const GroupRows& group : kGroups) {
    const auto rows = group.rows();
    table.insert(table.end(), rows.begin(), rows.end());
  }
  return table;
}

}  // namespace

Text heading_of(ActionGroup group) { return kGroups[static_cast<std::size_t>(group)].heading; }

std::span<const ActionRow> action_table() {
  static const std::vector<ActionRow> table = join_groups();
  return table;
}

std::span<const ActionRow> rows_of(ActionGroup group) {
  return action_table().subspan(first_of(group), end_of(group) - first_of(group));
}

const ActionRow& row_of(Action action) { return action_table()[index_of(action)]; }

std::optional<Action> action_of(const KeyEvent& press) {
  const auto rows = action_table();
  const int modifiers = press.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
  // A row that asks for Control or Shift goes first; else they do not matter: Ctrl Z is Z.
  for (const int wanted : {modifiers, 0}) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const ActionRow& candidate) {
      const auto is_pressed = [&](const Shortcut& shortcut) {
        return shortcut.key == press.key && shortcut.modifiers == wanted;
      };
      return is_pressed(candidate.shortcut) || is_pressed(candidate.second);
    });
    if (row == rows.end()) continue;
    if (press.is_repeat && !row->shortcut.repeats) return std::nullopt;
    return row->action;
  }
  return std::nullopt;
}

ActionState action_state(Action action, const AppView& view, const WindowState& state) {
  const ActionRow& row = row_of(action);
  ActionState result = row.state(Situation{view, state});
  // Pressing a key in the list of keys leaves the list.
  const bool is_blocked = state.dialog != Dialog::kNone && state.dialog != Dialog::kHelp &&
                          (row.works_in & in(state.dialog)) == 0;
  if (result.is_enabled && is_blocked) {
    result = {.is_enabled = false, .is_on = result.is_on, .why = Text::kCloseDialogFirst};
  }
  if (result.why) result.text = view.texts[*result.why];
  return result;
}

void perform(Action action, const AppView& view, WindowState& state,
             std::vector<Command>& commands) {
  if (!action_state(action, view, state).is_enabled) return;
  row_of(action).perform(ActionRunner{view, state, commands});
}

}  // namespace flytri::ui
