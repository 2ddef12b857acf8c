/// @file  Scan, finish, and choose what to scan next.
#include <GLFW/glfw3.h>

#include "ui/actions/action_groups.h"
#include "ui/state/camera_moves.h"

namespace flytri::ui {
namespace {

ActionState scan_state(const Situation& now) {
  const bool can_toggle =
      now.accepts(scan::ScanEvent::kStart) || now.accepts(scan::ScanEvent::kPause);
  if (now.view.file.is_opening || now.view.is_loading) return disabled("opening the case");
  if (!can_toggle) return disabled("finishing");
  if (now.is_finished()) return enabled("finished");
  if (now.view.file.is_read_only) return disabled("the case is read-only");
  if (now.view.is_scanning) return {true, true, "scanning"};
  return enabled("paused");
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
  if (now.is_finishing()) return disabled("finishing");
  if (now.is_finished()) return disabled("finished");
  if (now.view.file.is_read_only) return disabled("the case is read-only");
  return only_if(now.accepts(scan::ScanEvent::kFinish), "nothing scanned yet");
}

ActionState next_place_state(const Situation& now) {
  const bool is_lost = now.phase() == scan::ScanPhase::kContinuation;
  return only_if(is_lost && now.view.scan->reentry.size() > 1, "only when lost");
}

void choose_next_place(const ActionRunner& run) {
  const scan::ScanSnapshot& scan = *run.view.scan;
  run.send(ChooseReentry{(scan.chosen_reentry + 1) % scan.reentry.size()});
}

ActionState next_hole_state(const Situation& now) {
  return only_if(now.view.scan != nullptr && !now.view.scan->holes.empty(), "no holes found");
}

template <io::ScanStage kStage>
ActionState stage_state(const Situation& now) {
  if (!now.may_leave()) return disabled("finishing");
  const bool has_data = now.view.stage_has_data[static_cast<std::size_t>(kStage)];
  return {true, now.view.stage == kStage, has_data ? "scanned" : "empty"};
}

template <io::ScanStage kStage>
void select_stage(const ActionRunner& run) {
  run.send(SelectStage{kStage});
}

constexpr std::array kScanningActions = {
    ActionRow{.action = Action::kScan,
              .id = "scan",
              .name = "Scan or pause",
              .shortcut = {GLFW_KEY_SPACE, "Space"},
              .state = scan_state,
              .perform = scan_or_pause},
    ActionRow{.action = Action::kFinish,
              .id = "finish",
              .name = "Finish",
              .shortcut = {GLFW_KEY_F, "F"},
              .state = finish_state,
              .perform = send<Finish>},
    ActionRow{.action = Action::kNextPlace,
              .id = "next_place",
              .name = "Next place to resume",
              .shortcut = {GLFW_KEY_TAB, "Tab"},
              .state = next_place_state,
              .perform = choose_next_place},
    ActionRow{.action = Action::kNextHole,
              .id = "next_hole",
              .name = "Next hole",
              .shortcut = {GLFW_KEY_N, "N"},
              .state = next_hole_state,
              .perform = [](const ActionRunner& run) { show_next_hole(run.view, run.state); }},
    ActionRow{.action = Action::kStageUpper,
              .id = "upper",
              .name = "Upper jaw",
              .shortcut = {GLFW_KEY_F1, "F1"},
              .state = stage_state<io::ScanStage::kUpper>,
              .perform = select_stage<io::ScanStage::kUpper>},
    ActionRow{.action = Action::kStageLower,
              .id = "lower",
              .name = "Lower jaw",
              .shortcut = {GLFW_KEY_F2, "F2"},
              .state = stage_state<io::ScanStage::kLower>,
              .perform = select_stage<io::ScanStage::kLower>},
    ActionRow{.action = Action::kStageBite,
              .id = "bite",
              .name = "Bite",
              .shortcut = {GLFW_KEY_F3, "F3"},
              .state = stage_state<io::ScanStage::kBite>,
              .perform = select_stage<io::ScanStage::kBite>}};
static_assert(lists_all_of(ActionGroup::kScanning, kScanningActions));

}  // namespace

std::span<const ActionRow> scanning_actions() { return kScanningActions; }

}  // namespace flytri::ui
