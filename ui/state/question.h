/// @file  Questions before something is lost: what each asks, and the command that a yes sends.
#pragma once

#include <string>

#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::ui {

enum class QuestionKind {
  kClearStage,
  kDropModel,     ///< scanning again replaces the finished model
  kLeaveUnsaved,  ///< what is not saved ends with the program, or with the case
  kLeaveExport,   ///< files that are being exported end with the program
};

struct Question {
  QuestionKind kind = QuestionKind::kClearStage;
  Command command;  ///< if the answer is yes
};

struct QuestionWords {
  std::string title;
  std::string text;     ///< what goes, and whether it can be brought back
  std::string confirm;  ///< label of the button that says yes
};
[[nodiscard]] QuestionWords words_of(const Question& question, const AppView& view);

/// Whether something ends with the open case that is not on disk.
[[nodiscard]] bool has_unsaved(const AppView& view);

/// Whether scanning again replaces a finished model that the user has no copy of. The views stay,
/// but the next model has the new views, too: this one cannot be made again.
[[nodiscard]] bool would_lose_model(const AppView& view);

}  // namespace flytri::ui
