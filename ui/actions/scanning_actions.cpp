/// @file  Scan, finish, and choose what to scan next.
#include <GLFW/glfw3.h>

#include <algorithm>

#include "ui/actions/action_groups.h"
#include "ui/state/camera_moves.h"
#include "ui/state/stage_group.h"

namespace flytri::ui {
namespace {

ActionState scan_state(const Situation& now) {
  const bool can_toggle =
      now.accepts(scan::ScanEvent::kStart) || now.accepts(scan::ScanEvent::kPause);
  if (now.view.file.is_opening || now.view.is_loading) return disabled(Text::kOpeningTheCase);
  if (!can_toggle) return disabled(Text::kFinishing);
  if (now.is_finished()) return enabled(Text::kFinished);
  // A scan goes on while its case is found damaged, and can be paused.
  if (now.view.file.is_read_only && !now.view.is_scanning) return disabled(Text::kCaseIsReadOnly);
  if (now.view.is_scanning) return chosen(true, Text::kScanning);
  return enabled(Text::kPaused);
}

void scan_or_pause(const ActionRunner& run) {
  const bool is_finished =
      run.view.scan != nullptr && run.view.scan->phase == scan::ScanPhase::kFinished;
  if (is_finished) {
    if (would_lose_model(run.view)) return run.ask(QuestionKind::kDropModel, ResumeScan{});
    return run.send(ResumeScan{});
  }
  if (run.view.is_scanning) return run.send(PauseScan{});
  run.send(StartScan{});
}

ActionState finish_state(const Situation& now) {
  if (now.is_finishing()) return disabled(Text::kFinishing);
  if (now.is_finished()) return disabled(Text::kFinished);
  if (now.view.file.is_read_only) return disabled(Text::kCaseIsReadOnly);
  return only_if(now.accepts(scan::ScanEvent::kFinish), Text::kNothingScanned);
}

ActionState next_place_state(const Situation& now) {
  const bool is_lost = now.phase() == scan::ScanPhase::kContinuation;
  return only_if(is_lost && now.view.scan->reentry.size() > 1, Text::kOnlyWhenLost);
}

void choose_next_place(const ActionRunner& run) {
  const scan::ScanSnapshot& scan = *run.view.scan;
  run.send(ChooseReentry{(scan.chosen_reentry + 1) % scan.reentry.size()});
}

ActionState next_hole_state(const Situation& now) {
  return only_if(now.view.scan != nullptr && !now.view.scan->holes.empty(), Text::kNoHolesFound);
}

/// On while any scan of the same jaw or of the bite is shown.
template <io::ScanStage kStage>
ActionState stage_state(const Situation& now) {
  if (!now.may_leave()) return disabled(Text::kFinishing);
  const std::vector<io::ScanStage> tabs = offered_tabs(now.view);
  if (std::find(tabs.begin(), tabs.end(), base_of(kStage)) == tabs.end())
    return disabled(Text::kOtherSensor);
  const bool has_data = now.view.stage_has_data[index_of(kStage)];
  return {.is_on = base_of(now.view.stage) == kStage,
          .why = has_data ? Text::kScanned : Text::kEmpty};
}

ActionState bite_2_state(const Situation& now) {
  constexpr io::ScanStage kStage = io::ScanStage::kBite2;
  const std::vector<io::ScanStage> offered = offered_with(kStage, now.view);
  if (std::find(offered.begin(), offered.end(), kStage) == offered.end())
    return disabled(Text::kBiteFirst);
  ActionState state = stage_state<kStage>(now);
  state.is_on = now.view.stage == kStage;
  return state;
}

template <io::ScanStage kStage>
void select_stage(const ActionRunner& run) {
  run.send(SelectStage{kStage});
}

ActionState stages_state(const Situation& now) {
  if (!now.may_leave()) return disabled(Text::kFinishing);
  return only_if(io::is_jaw(now.view.stage), Text::kOnlyForAJaw);
}

void open_stages(const ActionRunner& run) {
  if (run.view.is_scanning) run.send(PauseScan{});
  put_tool_away(run.state);
  run.toggle(Dialog::kStages);
}

constexpr std::array kScanningActions = {
    ActionRow{.action = Action::kScan,
              .id = "scan",
              .name = Text::kScanOrPause,
              .shortcut = {GLFW_KEY_SPACE},
              .state = scan_state,
              .perform = scan_or_pause},
    ActionRow{.action = Action::kFinish,
              .id = "finish",
              .name = Text::kFinish,
              .shortcut = {GLFW_KEY_F},
              .state = finish_state,
              .perform = send<Finish>},
    ActionRow{.action = Action::kNextPlace,
              .id = "next_place",
              .name = Text::kNextPlace,
              .shortcut = {GLFW_KEY_TAB},
              .state = next_place_state,
              .perform = choose_next_place},
    ActionRow{.action = Action::kNextHole,
              .id = "next_hole",
              .name = Text::kNextHole,
              .shortcut = {GLFW_KEY_N},
              .state = next_hole_state,
              .perform = [](const ActionRunner& run) { show_next_hole(run.view, run.state); }},
    ActionRow{.action = Action::kStageUpper,
              .id = "upper",
              .name = Text::kUpperJaw,
              .shortcut = {GLFW_KEY_F1},
              .state = stage_state<io::ScanStage::kUpper>,
              .perform = select_stage<io::ScanStage::kUpper>},
    ActionRow{.action = Action::kStageLower,
              .id = "lower",
              .name = Text::kLowerJaw,
              .shortcut = {GLFW_KEY_F2},
              .state = stage_state<io::ScanStage::kLower>,
              .perform = select_stage<io::ScanStage::kLower>},
    ActionRow{.action = Action::kStageBite,
              .id = "bite",
              .name = Text::kBite,
              .shortcut = {GLFW_KEY_F3},
              .state = stage_state<io::ScanStage::kBite>,
              .perform = select_stage<io::ScanStage::kBite>},
    ActionRow{.action = Action::kStageBite2,
              .id = "bite_2",
              .name = Text::kBiteOtherSide,
              .shortcut = {GLFW_KEY_F4},
              .state = bite_2_state,
              .perform = select_stage<io::ScanStage::kBite2>},
    ActionRow{.action = Action::kStageFace,
              .id = "face",
              .name = Text::kFace,
              .shortcut = {GLFW_KEY_F7},
              .state = stage_state<io::ScanStage::kFace>,
              .perform = select_stage<io::ScanStage::kFace>,
              .is_listed = false},
    ActionRow{.action = Action::kStages,
              .id = "stages",
              .name = Text::kScansOfJaw,
              .shortcut = {GLFW_KEY_F6},
              .state = stages_state,
              .perform = open_stages,
              .works_in = in(Dialog::kStages)}};
static_assert(lists_all_of(ActionGroup::kScanning, kScanningActions));

}  // namespace

std::span<const ActionRow> scanning_actions() { return kScanningActions; }

}  // namespace flytri::ui
