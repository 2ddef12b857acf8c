#include "ui/state/question.h"

#include "ui/state/jaw_words.h"

namespace flytri::ui {
namespace {

void add_part(std::string& list, const std::string& part) {
  if (!list.empty()) list += ", ";
  list += part;
}

/// "12 views, 1 distance, the finished model"
std::string scan_text(const AppView& view) {
  std::string list;
  const Texts& texts = view.texts;
  if (view.scan != nullptr) {
    const std::int64_t views = view.scan->view_count();
    add_part(list, views > 0 ? texts.count<Text::kCountViews>(views)
                             : std::string(texts[Text::kTheScannedSurface]));
    if (view.scan->can_undo || view.scan->can_redo) add_part(list, texts[Text::kTrimsAndLocks]);
  }
  const auto distances = static_cast<std::int64_t>(view.measurements.size());
  if (distances > 0) add_part(list, texts.count<Text::kCountDistances>(distances));
  if (view.scan != nullptr && view.scan->result != nullptr) {
    add_part(list, texts[Text::kTheFinishedModel]);
  }
  return list;
}

QuestionWords clear_words(const AppView& view) {
  const Texts& texts = view.texts;
  QuestionWords words = {texts.fill<Text::kAskClear>(texts[stage_name(view.stage)]),
                         texts.fill<Text::kClearText>(scan_text(view)), texts[Text::kClear]};
  if (view.has_kept_scan) words.text += std::string(" ") + texts[Text::kClearAgainText];
  return words;
}

}  // namespace

QuestionWords words_of(const Question& question, const AppView& view) {
  const Texts& texts = view.texts;
  switch (question.kind) {
    case QuestionKind::kDropModel:
      return {texts[Text::kAskScanAgain], texts[Text::kScanAgainText],
              texts[Text::kButtonScanAgain]};
    case QuestionKind::kLeaveUnsaved:
      return {texts[Text::kAskLeave], texts.fill<Text::kLeaveText>(view.file.failure),
              texts[Text::kLeave]};
    case QuestionKind::kLeaveExport:
      return {texts[Text::kAskLeaveExport], texts[Text::kLeaveExportText], texts[Text::kLeave]};
    case QuestionKind::kClearStage:
      break;
  }
  return clear_words(view);
}

bool has_unsaved(const AppView& view) { return !view.file.failure.empty(); }

bool would_lose_model(const AppView& view) {
  return view.scan != nullptr && view.scan->result != nullptr && !view.exports.has_model;
}

}  // namespace flytri::ui
