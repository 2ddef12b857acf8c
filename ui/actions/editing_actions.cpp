/// @file  Change the surface, and measure on it.
#include <GLFW/glfw3.h>

#include <algorithm>

#include "ui/actions/action_groups.h"
#include "ui/state/jaws_look.h"
#include "ui/state/review_look.h"

namespace flytri::ui {
namespace {

constexpr double kBrushStep = 1.15;

/// Both scans of the stage stay in the case, so nothing can be lost.
bool can_bring_back(const Situation& now) {
  return now.view.has_kept_scan && !now.view.file.is_read_only && !now.view.is_loading &&
         now.may_leave();
}

/// What was cleared comes back by Undo until something new is there: then Undo is that of the new
/// scan.
bool undoes_clearing(const Situation& now) { return can_bring_back(now) && !now.has_surface(); }

/// While the points of a plane are clicked, Undo takes the last one back.
bool undoes_point(const WindowState& state) {
  return state.tool == Tool::kPlane && !state.plane_points_mm.empty();
}

bool undoes_click(const Situation& now) {
  return is_reviewing(now.view, now.state) && has_click(now.state);
}

ActionState undo_state(const Situation& now) {
  if (undoes_point(now.state)) return enabled();
  if (undoes_click(now)) return enabled(Text::kTakesClickBack);
  if (undoes_clearing(now)) return enabled(Text::kBringsScanBack);
  return only_if(now.can_edit() && now.view.scan->can_undo, Text::kNothingToUndo);
}

/// What was found from all clicks is no longer asked for.
void undo_click(const ActionRunner& run) {
  take_click_back(run.state);
  const ReviewForm& form = run.state.review;
  if (form.mode == ReviewMode::kMargin) run.send(DrawMargin{form.margin_mm});
  if (form.mode == ReviewMode::kSection && form.plane) run.send(CutSection{*form.plane, {}});
}

void undo(const ActionRunner& run) {
  if (undoes_point(run.state)) return run.state.plane_points_mm.pop_back();
  if (undoes_click({run.view, run.state})) return undo_click(run);
  if (undoes_clearing({run.view, run.state})) return run.send(BringBackStage{});
  run.send(Undo{});
}

ActionState clear_state(const Situation& now) {
  if (!now.has_surface()) return disabled(Text::kNothingScanned);
  if (!now.may_leave()) return disabled(Text::kFinishing);
  if (now.view.is_loading) return disabled(Text::kOpeningTheCase);
  if (now.view.file.is_read_only) return disabled(Text::kCaseIsReadOnly);
  return only_if(!now.view.file.path.empty() && !has_unsaved(now.view), Text::kNotSavedYet);
}

void ask_to_clear(const ActionRunner& run) {
  if (run.view.is_scanning) run.send(PauseScan{});
  put_tool_away(run.state);
  run.ask(QuestionKind::kClearStage, ClearStage{run.view.stage});
}

ActionState bring_back_state(const Situation& now) {
  return only_if(can_bring_back(now), Text::kNothingCleared);
}

void bring_back(const ActionRunner& run) {
  run.state.dialog = Dialog::kNone;
  run.send(BringBackStage{});
}

ActionState redo_state(const Situation& now) {
  return only_if(now.can_edit() && now.view.scan->can_redo, Text::kNothingToRedo);
}

template <Tool kTool>
ActionState tool_state(const Situation& now) {
  if (!now.has_surface()) return disabled(Text::kNothingScanned);
  if (shown_jaws(now.view, now.state) != nullptr) return disabled(Text::kNotForBothJaws);
  if (kTool != Tool::kMeasure && !now.can_edit()) {
    return disabled(now.is_finishing() ? Text::kFinishing : Text::kResumeFirst);
  }
  return chosen(now.state.tool == kTool, Text::kActive);
}

template <Tool kTool>
void toggle_tool(const ActionRunner& run) {
  run.toggle(kTool);
  if (is_reviewing(run.view, run.state)) run.send(BeginReview{});
}

template <ReviewMode kMode>
ActionState review_state(const Situation& now) {
  if (!now.is_finished()) return disabled(Text::kFinishTheScan);
  if (shown_jaws(now.view, now.state) != nullptr) return disabled(Text::kNotForBothJaws);
  return chosen(is_reviewing(now.view, now.state, kMode), Text::kActive);
}

template <ReviewMode kMode>
void review_by(const ActionRunner& run) {
  if (run.state.tool != Tool::kMeasure) run.toggle(Tool::kMeasure);
  run.state.review.mode = kMode;
  run.state.review.shows_undercut = true;
  run.send(BeginReview{});
}

ActionState brush_state(const Situation& now) {
  return only_if(has_brush(now.state.tool), Text::kChooseBrushFirst);
}

void scale_brush(const ActionRunner& run, double factor) {
  double& share = run.state.brush.radius_share;
  share = std::clamp(share * factor, 0.01, 0.5);
}

ActionState remove_measurement_state(const Situation& now) {
  return only_if(!now.view.measurements.empty(), Text::kNoneYet);
}

void remove_last_measurement(const ActionRunner& run) {
  run.send(RemoveMeasurement{run.view.measurements.size() - 1});
}

constexpr std::array kEditingActions = {
    ActionRow{.action = Action::kUndo,
              .id = "undo",
              .name = Text::kUndo,
              .shortcut = {GLFW_KEY_Z},
              .state = undo_state,
              .perform = undo},
    ActionRow{.action = Action::kRedo,
              .id = "redo",
              .name = Text::kRedo,
              .shortcut = {GLFW_KEY_Y},
              .second = {GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT},
              .state = redo_state,
              .perform = send<Redo>},
    ActionRow{.action = Action::kTrim,
              .id = "trim",
              .name = Text::kTrim,
              .shortcut = {GLFW_KEY_T},
              .state = tool_state<Tool::kTrim>,
              .perform = toggle_tool<Tool::kTrim>},
    ActionRow{.action = Action::kLock,
              .id = "lock",
              .name = Text::kLock,
              .shortcut = {GLFW_KEY_K},
              .state = tool_state<Tool::kLock>,
              .perform = toggle_tool<Tool::kLock>},
    ActionRow{.action = Action::kUnlock,
              .id = "unlock",
              .name = Text::kUnlock,
              .shortcut = {GLFW_KEY_J},
              .state = tool_state<Tool::kUnlock>,
              .perform = toggle_tool<Tool::kUnlock>},
    ActionRow{.action = Action::kBrushSmaller,
              .id = "brush_smaller",
              .name = Text::kSmallerBrush,
              .shortcut = {GLFW_KEY_LEFT_BRACKET, 0, true},
              .state = brush_state,
              .perform = [](const ActionRunner& run) { scale_brush(run, 1.0 / kBrushStep); }},
    ActionRow{.action = Action::kBrushLarger,
              .id = "brush_larger",
              .name = Text::kLargerBrush,
              .shortcut = {GLFW_KEY_RIGHT_BRACKET, 0, true},
              .state = brush_state,
              .perform = [](const ActionRunner& run) { scale_brush(run, kBrushStep); }},
    ActionRow{.action = Action::kMeasure,
              .id = "measure",
              .name = Text::kMeasure,
              .shortcut = {GLFW_KEY_M},
              .state = tool_state<Tool::kMeasure>,
              .perform = toggle_tool<Tool::kMeasure>},
    ActionRow{.action = Action::kMeasureDistance,
              .id = "measure_distance",
              .name = Text::kMeasureDistance,
              .shortcut = {GLFW_KEY_M, GLFW_MOD_SHIFT},
              .state = review_state<ReviewMode::kDistance>,
              .perform = review_by<ReviewMode::kDistance>,
              .is_listed = false},
    ActionRow{.action = Action::kMeasureAngle,
              .id = "measure_angle",
              .name = Text::kMeasureAngle,
              .shortcut = {GLFW_KEY_7},
              .state = review_state<ReviewMode::kAngle>,
              .perform = review_by<ReviewMode::kAngle>,
              .is_listed = false},
    ActionRow{.action = Action::kSection,
              .id = "section",
              .name = Text::kSection,
              .shortcut = {GLFW_KEY_8},
              .state = review_state<ReviewMode::kSection>,
              .perform = review_by<ReviewMode::kSection>,
              .is_listed = false},
    ActionRow{.action = Action::kUndercut,
              .id = "undercut",
              .name = Text::kUndercut,
              .shortcut = {GLFW_KEY_9},
              .state = review_state<ReviewMode::kUndercut>,
              .perform = review_by<ReviewMode::kUndercut>,
              .is_listed = false},
    ActionRow{.action = Action::kMargin,
              .id = "margin",
              .name = Text::kMargin,
              .shortcut = {GLFW_KEY_0},
              .state = review_state<ReviewMode::kMargin>,
              .perform = review_by<ReviewMode::kMargin>,
              .is_listed = false},
    ActionRow{.action = Action::kRemoveMeasurement,
              .id = "remove_measurement",
              .name = Text::kRemoveLastDistance,
              .shortcut = {GLFW_KEY_DELETE},
              .state = remove_measurement_state,
              .perform = remove_last_measurement},
    ActionRow{.action = Action::kClearStage,
              .id = "clear_stage",
              .name = Text::kClearStage,
              .shortcut = {GLFW_KEY_DELETE, GLFW_MOD_CONTROL},
              .state = clear_state,
              .perform = ask_to_clear},
    ActionRow{.action = Action::kBringBack,
              .id = "bring_back",
              .name = Text::kBringClearedBack,
              .shortcut = {GLFW_KEY_B, GLFW_MOD_CONTROL},
              .state = bring_back_state,
              .perform = bring_back,
              .works_in = in(Dialog::kQuestion)}};
static_assert(lists_all_of(ActionGroup::kEditing, kEditingActions));

}  // namespace

std::span<const ActionRow> editing_actions() { return kEditingActions; }

}  // namespace flytri::ui
