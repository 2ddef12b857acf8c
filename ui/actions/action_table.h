/// @file  The one table of what the user can do: name, key, whether it is possible now, what it
/// does.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/actions/action.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"
#include "ui/state/window_state.h"
#include "ui/text/texts.h"
#include "ui/window/input.h"

namespace flytri::ui {

struct Situation;
struct ActionRunner;

/// The key of an action.
struct Shortcut {
  int key = 0;           ///< GLFW_KEY_*
  int modifiers = 0;     ///< GLFW_MOD_CONTROL, GLFW_MOD_SHIFT or 0
  bool repeats = false;  ///< while the key is held
};

/// As it is printed on a keyboard: "Ctrl Z".
[[nodiscard]] std::string shortcut_text(const Shortcut& shortcut, const Texts& texts);

/// Whether an action is possible now.
struct ActionState {
  bool is_enabled = true;
  bool is_on = false;  ///< the tool or mode is chosen
  /// Why it is disabled, or its setting. Short: it stands in the list of keys. Rows of the table
  /// give its key, where it has one; then action_state() finds the text.
  std::optional<Text> why = {};
  std::string text = {};
};

/// Always possible.
[[nodiscard]] ActionState always(const Situation& situation);

/// A set of dialogs, as bits.
using Dialogs = unsigned;
[[nodiscard]] constexpr Dialogs in(Dialog dialog) { return 1U << static_cast<unsigned>(dialog); }
inline constexpr Dialogs kNoDialog = 0, kEachDialog = ~0U;

/// A row of the table.
struct ActionRow {
  Action action;
  const char* id;  ///< of its button, and on the control channel: "scan"
  Text name;       ///< what it does, in the user's words
  Shortcut shortcut;
  Shortcut second = {};  ///< another key that does the same; the list of keys does not show it
  ActionState (*state)(const Situation&) = always;
  void (*perform)(const ActionRunner&) = nullptr;
  /// The open dialogs that leave it possible. The list of keys always does.
  Dialogs works_in = kNoDialog;
  /// False: the list of keys leaves it to the panel of its tool.
  bool is_listed = true;
};

/// All rows, in the order of Action.
[[nodiscard]] std::span<const ActionRow> action_table();
[[nodiscard]] std::span<const ActionRow> rows_of(ActionGroup group);
[[nodiscard]] const ActionRow& row_of(Action action);

/// What a key does. Control and Shift count where a row of the table asks for them.
[[nodiscard]] std::optional<Action> action_of(const KeyEvent& press);

[[nodiscard]] ActionState action_state(Action action, const AppView& view,
                                       const WindowState& state);

/// Carries an action out, in the window's own state or as a command to the program. Keys, buttons
/// and the control channel all end here. Nothing happens where action_state() says disabled.
void perform(Action action, const AppView& view, WindowState& state,
             std::vector<Command>& commands);

}  // namespace flytri::ui
