#include "ui/state/question.h"

#include <fmt/format.h>

#include <vector>

#include "ui/state/jaw_words.h"

namespace flytri::ui {
namespace {

std::string numbered(std::int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// "12 views, 1 distance and the finished model"
std::string content_of(const AppView& view) {
  std::vector<std::string> parts;
  if (view.scan != nullptr) {
    const std::int64_t views = view.scan->counts.registered + view.scan->counts.interpolated;
    parts.push_back(views > 0 ? numbered(views, "view", "views") : "the scanned surface");
    if (view.scan->can_undo || view.scan->can_redo) parts.emplace_back("what was trimmed and locked");
  }
  if (!view.measurements.empty()) {
    parts.push_back(numbered(static_cast<std::int64_t>(view.measurements.size()), "distance",
                             "distances"));
  }
  if (view.scan != nullptr && view.scan->result != nullptr) parts.emplace_back("the finished model");
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

QuestionWords clear_words(const AppView& view) {
  const std::string stage = stage_name(view.stage);
  QuestionWords words = {fmt::format("Clear the {}?", stage),
                         fmt::format("The {} becomes empty: {} go. The case keeps them until the {} "
                                     "is cleared again; Undo (Z) brings them back.",
                                     stage, content_of(view), stage),
                         "Clear"};
  if (view.has_kept_scan) {
    words.text +=
        " The scan that was cleared before is deleted for good. To go on with that one instead, "
        "bring it back.";
  }
  return words;
}

}  // namespace

QuestionWords words_of(const Question& question, const AppView& view) {
  switch (question.kind) {
    case QuestionKind::kDropModel:
      return {"Scan again?",
              "The finished model was not exported. Once you scan, Finish makes another model, with "
              "the new views. Export this one first if you need it.",
              "Scan again"};
    case QuestionKind::kLeaveUnsaved:
      return {"Leave without saving?",
              "Not everything is saved, and what is not is lost: " + view.file.failure,
              "Leave"};
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
