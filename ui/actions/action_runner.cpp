#include "ui/actions/action_runner.h"

namespace flytri::ui {

void ActionRunner::toggle(Tool tool) const {
  const bool was_in_hand = state.tool == tool;
  put_tool_away(state);
  if (!was_in_hand) state.tool = tool;
}

void ActionRunner::toggle(Dialog dialog) const {
  state.dialog = state.dialog == dialog ? Dialog::kNone : dialog;
}

void ActionRunner::ask(QuestionKind kind, Command command) const {
  state.question = {kind, std::move(command)};
  state.dialog = Dialog::kQuestion;
}

}  // namespace flytri::ui
