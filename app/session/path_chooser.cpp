#include "app/session/path_chooser.h"

#include <utility>

#include "app/session/user_folders.h"

namespace flytri::session {
namespace {

desktop::ChooserQuestion question_of(const ui::ChoosePath& command, const ui::Texts& texts) {
  desktop::ChooserQuestion question;
  question.now = typed_folder(command.now, texts).value_or(std::filesystem::path());
  switch (command.field) {
    case ui::PathField::kCase:
    case ui::PathField::kNewCase:
      question.kind = command.field == ui::PathField::kCase ? desktop::ChooserKind::kOpenFile
                                                            : desktop::ChooserKind::kSaveFile;
      question.title = texts[command.field == ui::PathField::kCase ? ui::Text::kOpenACase
                                                                   : ui::Text::kSaveACase];
      question.filter_name = texts[ui::Text::kCases];
      question.filter_glob = "*.flytri";
      return question;
    case ui::PathField::kExportFolder:
      question.title = texts[ui::Text::kFolderForModels];
      break;
    case ui::PathField::kCalibrationFolder:
      question.title = texts[ui::Text::kCalibrationFolder];
      break;
    case ui::PathField::kRecordingFolder:
      question.title = texts[ui::Text::kRecordingFolder];
      break;
  }
  question.kind = desktop::ChooserKind::kFolder;
  return question;
}

}  // namespace

PathChooser::PathChooser(std::shared_ptr<desktop::FileChooser> chooser, Notices& notices)
    : chooser_(chooser != nullptr ? std::move(chooser) : desktop::portal_file_chooser()),
      notices_(notices) {}

void PathChooser::choose(const ui::ChoosePath& command) {
  if (state_.is_open) return;
  if (auto asked = chooser_->ask(question_of(command, notices_.texts())); !asked) {
    return notices_.add(ui::Severity::kWarning, asked.error().message);
  }
  field_ = command.field;
  state_.is_open = true;
}

ui::ChooserState PathChooser::state() {
  if (const auto answer = chooser_->settle()) {
    state_.is_open = false;
    if (answer->path) state_.chosen = ui::ChosenPath{++chosen_, field_, answer->path->string()};
    if (!answer->failure.empty()) notices_.add(ui::Severity::kWarning, answer->failure);
  }
  state_.why_not = chooser_->why_not();
  return state_;
}

}  // namespace flytri::session
