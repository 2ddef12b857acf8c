/// @file  What an action may change: the window's own state, and the commands to the program.
#pragma once

#include <utility>
#include <vector>

#include "ui/state/app_view.h"
#include "ui/state/command.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Handed to ActionRow::perform, once the action is known to be possible.
struct ActionRunner {
  const AppView& view;
  WindowState& state;
  std::vector<Command>& commands;

  void send(Command command) const { commands.push_back(std::move(command)); }
  /// Takes the tool in hand, or puts it away.
  void toggle(Tool tool) const;
  /// Opens the dialog in place of another, or closes it.
  void toggle(Dialog dialog) const;
  /// Sends the command once the user has said yes.
  void ask(QuestionKind kind, Command command) const;
};

/// For rows of the table.
template <Dialog kDialog>
void toggle_dialog(const ActionRunner& run) {
  run.toggle(kDialog);
}
template <typename SomeCommand>
void send(const ActionRunner& run) {
  run.send(SomeCommand{});
}

}  // namespace flytri::ui
