#include "ui/actions/action_table.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <set>

namespace flytri::ui {
namespace {

std::shared_ptr<const scan::ScanSnapshot> scan_in(scan::ScanPhase phase) {
  auto scan = std::make_shared<scan::ScanSnapshot>();
  scan->phase = phase;
  scan->model = {std::make_shared<SurfelBlock>(SurfelBlock{0, {Surfel{}}})};
  return scan;
}

std::vector<std::string_view> names_after(Action action, const AppView& view, WindowState& state) {
  std::vector<Command> commands;
  perform(action, view, state, commands);
  std::vector<std::string_view> names;
  for (const Command& command : commands) names.push_back(name_of(command));
  return names;
}

using Names = std::vector<std::string_view>;

// That each action has a row is checked by the compiler, see lists_all_of().
TEST(ActionTable, RowsAreInOrderAndNoIdOrKeyServesTwo) {
  std::set<std::string> ids;
  std::set<std::pair<int, int>> keys;
  for (const ActionRow& row : action_table()) {
    EXPECT_EQ(row_of(row.action).id, row.id);
    EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    EXPECT_TRUE(keys.insert({row.shortcut.key, row.shortcut.modifiers}).second)
        << shortcut_text(row.shortcut, Texts());
    if (row.second.key == 0) continue;
    EXPECT_TRUE(keys.insert({row.second.key, row.second.modifiers}).second)
        << shortcut_text(row.second, Texts());
  }
  EXPECT_EQ(action_table().size(), index_of(Action::kCount));
}

TEST(ActionTable, NothingButQuitQuits) {
  AppView view;
  view.scan = scan_in(scan::ScanPhase::kMeasurement);
  for (const ActionRow& row : action_table()) {
    WindowState state;
    const bool quits = names_after(row.action, view, state) == Names{"Quit"};
    EXPECT_EQ(quits, row.action == Action::kQuit) << row.id;
  }
}

TEST(ActionTable, ControlAndShiftCountWhereARowAsksForThem) {
  EXPECT_EQ(action_of({GLFW_KEY_Z, 0, true, false}), Action::kUndo);
  EXPECT_EQ(action_of({GLFW_KEY_Z, GLFW_MOD_CONTROL, true, false}), Action::kUndo);
  EXPECT_EQ(action_of({GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, true, false}), Action::kRedo);
  EXPECT_EQ(action_of({GLFW_KEY_Y, GLFW_MOD_CONTROL, true, false}), Action::kRedo);
  EXPECT_EQ(action_of({GLFW_KEY_EQUAL, 0, true, false}), Action::kZoomIn);
  EXPECT_EQ(action_of({GLFW_KEY_EQUAL, GLFW_MOD_CONTROL, true, false}), Action::kLarger);
  EXPECT_EQ(action_of({GLFW_KEY_LEFT, GLFW_MOD_SHIFT, true, false}), Action::kTiltLeft);
  EXPECT_EQ(action_of({GLFW_KEY_T, GLFW_MOD_CAPS_LOCK, true, false}), Action::kTrim);
  EXPECT_EQ(action_of({GLFW_KEY_F12, 0, true, false}), std::nullopt);
}

TEST(ActionTable, OnlyActionsThatMoveRepeatWhileTheKeyIsHeld) {
  EXPECT_EQ(action_of({GLFW_KEY_LEFT, 0, true, true}), Action::kLeft);
  EXPECT_EQ(action_of({GLFW_KEY_SPACE, 0, true, true}), std::nullopt);
}

TEST(ActionTable, ScanKeyStartsPausesAndResumes) {
  AppView view;
  WindowState state;
  EXPECT_EQ(names_after(Action::kScan, view, state), Names{"StartScan"});
  view.scan = scan_in(scan::ScanPhase::kMeasurement);
  view.is_scanning = true;
  EXPECT_EQ(names_after(Action::kScan, view, state), Names{"PauseScan"});
  view.scan = scan_in(scan::ScanPhase::kFinished);
  // Without a result there is nothing to lose.
  EXPECT_EQ(names_after(Action::kScan, view, state), Names{"ResumeScan"});
  view.scan = scan_in(scan::ScanPhase::kFinishing);
  EXPECT_EQ(names_after(Action::kScan, view, state), Names{});
}

TEST(ActionTable, DisabledActionsDoNothing) {
  const AppView view;
  WindowState state;
  for (const ActionRow& row : action_table()) {
    if (action_state(row.action, view, state).is_enabled) continue;
    EXPECT_EQ(names_after(row.action, view, state), Names{}) << row.id;
  }
}

TEST(ActionTable, WhileFinishingNoOtherStageOrCaseCanBeChosen) {
  AppView view;
  view.scan = scan_in(scan::ScanPhase::kFinishing);
  WindowState state;
  EXPECT_FALSE(action_state(Action::kStageBite, view, state).is_enabled);
  EXPECT_FALSE(action_state(Action::kCalibration, view, state).is_enabled);
  EXPECT_FALSE(action_state(Action::kFinish, view, state).is_enabled);
  state.dialog = Dialog::kCase;
  state.case_form.tab = CaseTab::kNew;
  state.case_form.path = "a.flytri";
  EXPECT_FALSE(action_state(Action::kConfirm, view, state).is_enabled);
  view.scan = scan_in(scan::ScanPhase::kFinished);
  EXPECT_TRUE(action_state(Action::kConfirm, view, state).is_enabled);
}

TEST(ActionTable, CancelClosesOneThingAtATime) {
  AppView view;
  view.scan = scan_in(scan::ScanPhase::kFinishing);
  WindowState state;
  state.dialog = Dialog::kHelp;
  state.tool = Tool::kMeasure;
  EXPECT_EQ(names_after(Action::kCancel, view, state), Names{});
  EXPECT_EQ(state.dialog, Dialog::kNone);
  EXPECT_EQ(names_after(Action::kCancel, view, state), Names{});
  EXPECT_EQ(state.tool, Tool::kNone);
  EXPECT_EQ(names_after(Action::kCancel, view, state), Names{"CancelFinish"});
}

TEST(ActionTable, ArrowKeysTurnTheViewOrMoveTheSensor) {
  AppView view;
  WindowState state;
  const Eigen::Quaterniond before = state.view.camera.pose().q_world_eye;
  state.view.picture = {800, 600};
  EXPECT_EQ(names_after(Action::kLeft, view, state), Names{});
  EXPECT_GT(before.angularDistance(state.view.camera.pose().q_world_eye), 0.01);
  view.source.hand = SimulatedHand{.follows_path = false};
  std::vector<Command> commands;
  perform(Action::kLeft, view, state, commands);
  ASSERT_EQ(commands.size(), 1U);
  // As the live image shows it: left is -x.
  EXPECT_LT(std::get<SteerHand>(commands.front()).move_mm.x(), 0.0);
  EXPECT_EQ(std::get<SteerHand>(commands.front()).turn_rad, Vec3(Vec3::Zero()));
}

TEST(ActionTable, AnOpenDialogBlocksTheActionsOfOthers) {
  AppView view;
  view.scan = scan_in(scan::ScanPhase::kMeasurement);
  WindowState state;
  state.dialog = Dialog::kExport;
  EXPECT_FALSE(action_state(Action::kTrim, view, state).is_enabled);
  EXPECT_FALSE(action_state(Action::kCase, view, state).is_enabled);
  EXPECT_TRUE(action_state(Action::kExport, view, state).is_enabled);
  EXPECT_TRUE(action_state(Action::kCancel, view, state).is_enabled);
}

/// A finished scan whose export dialog is open; every format can be exported.
AppView view_to_export(WindowState& state) {
  AppView view;
  view.scan = scan_in(scan::ScanPhase::kFinished);
  view.exports.estimated_bytes = {{".glb", 1}, {".ply", 1}, {".stl", 1}, {".obj", 1}};
  state.dialog = Dialog::kExport;
  state.export_form.folder = "/tmp";
  state.export_form.name = "jaw";
  return view;
}

Export confirmed_export(const AppView& view, WindowState& state) {
  std::vector<Command> commands;
  perform(Action::kConfirm, view, state, commands);
  return commands.size() == 1 ? std::get<Export>(commands.front()) : Export{};
}

TEST(ActionTable, ConfirmExportsTheRememberedFormats) {
  WindowState state;
  AppView view = view_to_export(state);
  EXPECT_EQ(confirmed_export(view, state).target,
            (ExportTarget{"/tmp", "jaw", {".glb", ".ply", ".stl"}}));
  view.settings.export_formats = {".obj"};
  EXPECT_EQ(confirmed_export(view, state).target.formats, std::vector<std::string_view>{".obj"});
  view.settings.export_formats = {};
  EXPECT_FALSE(action_state(Action::kConfirm, view, state).is_enabled);
}

TEST(ActionTable, BeforeFinishOnlyFormatsThatHoldPointsAreExported) {
  WindowState state;
  AppView view = view_to_export(state);
  view.exports.estimated_bytes = {{".ply", 1}};
  EXPECT_EQ(confirmed_export(view, state).target.formats, std::vector<std::string_view>{".ply"});
  view.settings.export_formats = {".glb"};
  EXPECT_FALSE(action_state(Action::kConfirm, view, state).is_enabled);
}

TEST(ActionTable, OnlyFilesThatTheUserWasToldOfAreReplaced) {
  WindowState state;
  AppView view = view_to_export(state);
  EXPECT_TRUE(confirmed_export(view, state).replaced.empty());
  view.exports.latest = confirmed_export(view, state).target;
  view.exports.existing = {"/tmp/jaw.glb"};
  EXPECT_EQ(confirmed_export(view, state).replaced, std::vector<std::string>{"/tmp/jaw.glb"});
  state.export_form.name = "other";
  EXPECT_TRUE(confirmed_export(view, state).replaced.empty()) << "asked for another name";
}

TEST(ActionTable, TheFolderOpensOnceSomethingIsExported) {
  WindowState state;
  AppView view = view_to_export(state);
  EXPECT_EQ(names_after(Action::kOpenExportFolder, view, state), Names{});
  view.exports.written = {{"/tmp/jaw.glb", 1}};
  EXPECT_EQ(names_after(Action::kOpenExportFolder, view, state), Names{"OpenExportFolder"});
}

TEST(ActionTable, CaseDialogStaysUntilTheCaseIsOpen) {
  const AppView view;
  WindowState state;
  state.dialog = Dialog::kCase;
  state.case_form.path = "/tmp/a.flytri";
  state.case_form.passphrase = state.case_form.passphrase_again = Secret("secret");
  std::vector<Command> commands;
  perform(Action::kConfirm, view, state, commands);
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(std::get<NewCase>(commands.front()).passphrase.view(), "secret");
  EXPECT_EQ(state.dialog, Dialog::kCase);
  EXPECT_TRUE(state.case_form.passphrase.empty()) << "kept only as long as needed";
}

TEST(ActionTable, NextPlaceStartsOverAfterTheLast) {
  AppView view;
  auto scan = std::make_shared<scan::ScanSnapshot>(*scan_in(scan::ScanPhase::kContinuation));
  scan->reentry.resize(3);
  scan->chosen_reentry = 2;
  view.scan = scan;
  WindowState state;
  std::vector<Command> commands;
  perform(Action::kNextPlace, view, state, commands);
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(std::get<ChooseReentry>(commands.front()).index, 0U);
}

}  // namespace
}  // namespace flytri::ui
