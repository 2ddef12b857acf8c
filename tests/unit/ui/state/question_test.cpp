#include "ui/state/question.h"

#include <gmock/gmock.h>

namespace flytri::ui {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

AppView scanned_view() {
  AppView view;
  auto scan = std::make_shared<scan::ScanSnapshot>();
  scan->counts.registered = 11;
  scan->counts.interpolated = 1;
  scan->can_undo = true;
  scan->result = std::make_shared<const reconstruct::FinishedScan>();
  view.scan = scan;
  view.stage = io::ScanStage::kLower;
  view.measurements.resize(1);
  return view;
}

TEST(Question, NamesTheStageAndWhatGoes) {
  AppView view = scanned_view();
  const Question question = {QuestionKind::kClearStage, ClearStage{view.stage}};
  QuestionWords words = words_of(question, view);
  EXPECT_EQ(words.title, "Lower jaw: clear everything?");
  EXPECT_THAT(words.text, HasSubstr("12 views, trims and locks, 1 distance, the finished model."));
  EXPECT_THAT(words.text, HasSubstr("Undo brings it back"));
  EXPECT_THAT(words.text, Not(HasSubstr("deleted for good")));
  view.has_kept_scan = true;
  words = words_of(question, view);
  EXPECT_THAT(words.text, HasSubstr("cleared before is deleted for good"));
}

TEST(Question, OnlyAModelThatWasNotExportedIsLost) {
  AppView view = scanned_view();
  EXPECT_TRUE(would_lose_model(view));
  view.exports.has_model = true;
  EXPECT_FALSE(would_lose_model(view));
  view = AppView();
  EXPECT_FALSE(would_lose_model(view));
}

TEST(Question, SaysWhyNotEverythingIsSaved) {
  AppView view;
  EXPECT_FALSE(has_unsaved(view));
  view.file.failure = "a.flytri: no space left";
  EXPECT_TRUE(has_unsaved(view));
  EXPECT_THAT(words_of({QuestionKind::kLeaveUnsaved, Quit{}}, view).text,
              HasSubstr("a.flytri: no space left"));
}

TEST(Question, SaysThatFilesAreStillBeingWritten) {
  EXPECT_THAT(words_of({QuestionKind::kLeaveExport, Quit{}}, AppView()).text,
              HasSubstr("still being written"));
}

}  // namespace
}  // namespace flytri::ui
