#include "ui/state/chosen_path.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

TEST(ChosenPath, GoesIntoItsFieldOnce) {
  AppView view;
  WindowState state;
  view.chooser.chosen = ChosenPath{1, PathField::kExportFolder, "/a"};
  take_chosen_path(view, state);
  EXPECT_EQ(state.export_form.folder, "/a");
  EXPECT_TRUE(state.export_form.is_folder_edited);
  state.export_form.folder = "/typed";
  take_chosen_path(view, state);
  EXPECT_EQ(state.export_form.folder, "/typed") << "what is typed later counts";
  view.chooser.chosen = ChosenPath{2, PathField::kRecordingFolder, "/b"};
  take_chosen_path(view, state);
  EXPECT_EQ(state.recording_form.folder, "/b");
  view.chooser.chosen = ChosenPath{3, PathField::kCalibrationFolder, "/c"};
  take_chosen_path(view, state);
  EXPECT_EQ(state.calibration_form.folder, "/c");
}

TEST(ChosenPath, ANewCaseGetsItsEnding) {
  AppView view;
  WindowState state;
  view.chooser.chosen = ChosenPath{1, PathField::kNewCase, "/a/b"};
  take_chosen_path(view, state);
  EXPECT_EQ(state.case_form.path, "/a/b.flytri");
  EXPECT_TRUE(state.case_form.is_path_edited);
  view.chooser.chosen = ChosenPath{2, PathField::kNewCase, "/a/c.flytri"};
  take_chosen_path(view, state);
  EXPECT_EQ(state.case_form.path, "/a/c.flytri");
  view.chooser.chosen = ChosenPath{3, PathField::kCase, "/a/d"};
  take_chosen_path(view, state);
  EXPECT_EQ(state.case_form.path, "/a/d");
}

}  // namespace
}  // namespace flytri::ui
