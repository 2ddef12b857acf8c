/// @file  How each action of the key map stands: the one place that knows what is possible when.
#include <fmt/format.h>

#include "ui/actions/key_map.h"

namespace flytri::ui {
namespace {

/// What the rules below ask of a view, with or without a scan.
struct Facts {
  const AppView& view;
  const WindowState& state;

  [[nodiscard]] scan::ScanPhase phase() const {
    return view.scan == nullptr ? scan::ScanPhase::kPreview : view.scan->phase;
  }
  [[nodiscard]] bool is(scan::ScanPhase wanted) const { return phase() == wanted; }
  [[nodiscard]] bool has_surface() const {
    return view.scan != nullptr && (surfel_count(view.scan->model) > 0 || has_result());
  }
  [[nodiscard]] bool has_result() const {
    return view.scan != nullptr && view.scan->result != nullptr;
  }
  [[nodiscard]] bool can_edit() const {
    return has_surface() && !is(scan::ScanPhase::kFinishing) && !is(scan::ScanPhase::kFinished);
  }
  [[nodiscard]] bool steers() const {
    return view.source.hand.has_value() && !view.source.hand->follows_path;
  }
};

ActionState disabled(std::string why) { return {false, false, std::move(why)}; }
ActionState enabled(std::string text = {}) { return {true, false, std::move(text)}; }
ActionState chosen(bool is_on, std::string text = "on") {
  return {true, is_on, is_on ? std::move(text) : std::string()};
}
ActionState only_if(bool is_possible, const char* why) {
  return is_possible ? enabled() : disabled(why);
}

ActionState scan_state(const Facts& facts) {
  if (facts.is(scan::ScanPhase::kFinishing)) return disabled("finishing");
  if (facts.is(scan::ScanPhase::kFinished)) return enabled("finished");
  if (facts.view.file.is_read_only) return disabled("the case is read-only");
  if (facts.view.is_scanning) return {true, true, "scanning"};
  return enabled("paused");
}

ActionState stage_state(const Facts& facts, io::ScanStage stage) {
  if (facts.is(scan::ScanPhase::kFinishing)) return disabled("finishing");
  const bool has_data = facts.view.stage_has_data[static_cast<std::size_t>(stage)];
  return {true, facts.view.stage == stage, has_data ? "scanned" : "empty"};
}

ActionState finish_state(const Facts& facts) {
  if (facts.is(scan::ScanPhase::kFinishing)) return disabled("running");
  if (facts.is(scan::ScanPhase::kFinished)) return disabled("finished");
  if (facts.view.file.is_read_only) return disabled("the case is read-only");
  return only_if(facts.has_surface(), "nothing scanned yet");
}

ActionState scanning_state(Action action, const Facts& facts) {
  switch (action) {
    case Action::kScan:
      return scan_state(facts);
    case Action::kFinish:
      return finish_state(facts);
    case Action::kNextPlace:
      return only_if(
          facts.is(scan::ScanPhase::kContinuation) && facts.view.scan->reentry.size() > 1,
          "while lost");
    case Action::kNextHole:
      return only_if(facts.view.scan != nullptr && !facts.view.scan->holes.empty(),
                     "no holes found");
    case Action::kStageUpper:
      return stage_state(facts, io::ScanStage::kUpper);
    case Action::kStageLower:
      return stage_state(facts, io::ScanStage::kLower);
    default:
      return stage_state(facts, io::ScanStage::kBite);
  }
}

ActionState tool_state(const Facts& facts, Tool tool) {
  if (!facts.has_surface()) return disabled("nothing scanned yet");
  if (tool != Tool::kMeasure && !facts.can_edit()) return disabled("go on scanning first");
  return chosen(facts.state.tool == tool, "in hand");
}

ActionState editing_state(Action action, const Facts& facts) {
  const bool can_step = facts.can_edit();
  switch (action) {
    case Action::kUndo:
      return only_if(can_step && facts.view.scan->can_undo, "nothing to undo");
    case Action::kRedo:
      return only_if(can_step && facts.view.scan->can_redo, "nothing to redo");
    case Action::kTrim:
      return tool_state(facts, Tool::kTrim);
    case Action::kLock:
      return tool_state(facts, Tool::kLock);
    case Action::kUnlock:
      return tool_state(facts, Tool::kUnlock);
    case Action::kMeasure:
      return tool_state(facts, Tool::kMeasure);
    case Action::kRemoveMeasurement:
      return only_if(!facts.view.measurements.empty(), "none yet");
    default:
      return only_if(has_brush(facts.state.tool), "no brush in hand");
  }
}

ActionState looking_state(Action action, const Facts& facts) {
  const WindowState& state = facts.state;
  switch (action) {
    case Action::kShading:
      return chosen(state.color_mode == ColorMode::kShading);
    case Action::kTexture:
      return chosen(state.color_mode == ColorMode::kTexture,
                    fmt::format("{:.0f} %", 100.0 * state.texture_blend));
    case Action::kCoverage:
      return chosen(state.color_mode == ColorMode::kCoverage);
    case Action::kUncertainty:
      return chosen(state.color_mode == ColorMode::kUncertainty);
    case Action::kBlendLess:
    case Action::kBlendMore:
      return only_if(state.color_mode == ColorMode::kTexture, "with texture");
    case Action::kOcclusal:
    case Action::kBuccal:
    case Action::kLingual:
      return only_if(facts.has_surface(), "nothing scanned yet");
    case Action::kShowAll:
      return chosen(state.view.follows_scan, "following");
    default:
      return enabled();
  }
}

ActionState hand_state(Action action, const Facts& facts) {
  const bool has_hand = facts.view.source.hand.has_value();
  switch (action) {
    case Action::kLeft:
    case Action::kRight:
    case Action::kUp:
    case Action::kDown:
      return enabled(facts.steers() ? "moves sensor" : "turns the view");
    case Action::kHandMode:
      if (!has_hand) return disabled("if simulated");
      return chosen(facts.steers(), "yours");
    case Action::kTakeAway:
      if (!has_hand) return disabled("if simulated");
      return chosen(facts.view.source.hand->is_taken_away, "away");
    default:
      return only_if(facts.steers(), "only by hand");
  }
}

ActionState cancel_state(const Facts& facts) {
  if (facts.state.dialog == Dialog::kCalibration && facts.view.calibration &&
      facts.view.calibration->running) {
    return enabled("stops the calibration");
  }
  if (facts.state.dialog != Dialog::kNone) return enabled("closes the dialog");
  if (facts.state.tool != Tool::kNone) return enabled("puts the tool down");
  if (facts.is(scan::ScanPhase::kFinishing)) return enabled("cancels finishing");
  if (facts.state.selected_hole) return enabled("leaves the hole");
  return disabled("nothing to cancel");
}

/// Why the panel's main button does nothing now; empty: it does.
std::string why_not_confirmed(const CalibrationState& calibration) {
  if (!calibration.running) return "choose what to do";
  switch (calibration.running->step) {
    case CalibrationStep::kTarget:
      return {};
    case CalibrationStep::kDone:
      if (calibration.running->task != CalibrationTask::kCalibrate) return "done";
      return calibration.why_not_used;
    case CalibrationStep::kRefused:
      return "choose a place";
    case CalibrationStep::kFailed:
      return "failed";
    default:
      return "wait";
  }
}

bool can_confirm(const Facts& facts) {
  const ExportForm& form = facts.state.export_form;
  switch (facts.state.dialog) {
    case Dialog::kExport:
      return !facts.view.exports.is_running && !form.name.empty() && !form.formats.empty();
    case Dialog::kCase:
      if (facts.state.case_form.tab == CaseTab::kFields) return !facts.view.file.is_read_only;
      return !facts.state.case_form.path.empty();
    default:
      return facts.state.dialog != Dialog::kNone;
  }
}

ActionState begin_state(Action action, const CalibrationState& calibration, const Facts& facts) {
  if (facts.state.dialog != Dialog::kCalibration) return disabled("after Calibration");
  if (calibration.running) return disabled("running");
  if (action == Action::kCalibrate) return enabled();
  if (!calibration.has_calibration) return disabled("no calibration yet");
  if (action == Action::kCheckOnSphere && calibration.is_simulated)
    return disabled("only of a real sensor");
  const bool has_diameter = typed_length_mm(facts.state.calibration_form.sphere_diameter_mm) > 0.0;
  return only_if(action == Action::kCheckOnPlane || has_diameter, "type its diameter");
}

ActionState calibrating_state(Action action, const Facts& facts) {
  const auto& calibration = facts.view.calibration;
  if (!calibration) return disabled("not of a recording");
  if (action != Action::kCalibration && action != Action::kPlaceBefore)
    return begin_state(action, *calibration, facts);
  if (action == Action::kCalibration) {
    if (facts.is(scan::ScanPhase::kFinishing)) return disabled("finishing");
    const bool is_open = facts.state.dialog == Dialog::kCalibration;
    return is_open && calibration->running ? disabled("running") : enabled();
  }
  if (!calibration->running) return disabled("while calibrating");
  const CalibrationStep step = calibration->running->step;
  const bool waits = step == CalibrationStep::kTarget || step == CalibrationStep::kRefused;
  return only_if(waits && place_before(*calibration->running), "nothing taken");
}

ActionState devices_state(Action action, const Facts& facts) {
  const auto& devices = facts.view.devices;
  if (!devices) return disabled("only with a rig");
  if (action == Action::kCheckDevices) return only_if(!devices->is_checking, "running");
  return enabled(devices->problems.empty() ? "" : "has problems");
}

ActionState program_state(Action action, const Facts& facts) {
  switch (action) {
    case Action::kDevices:
    case Action::kCheckDevices:
      return devices_state(action, facts);
    case Action::kExport:
      return only_if(facts.has_surface() && !facts.is(scan::ScanPhase::kFinishing),
                     "nothing to export yet");
    case Action::kMute:
      return enabled(facts.view.settings.is_muted ? "muted" : "on");
    case Action::kLarger:
    case Action::kSmaller:
      return enabled(fmt::format("{:.0f} %", 100.0 * facts.view.settings.user_scale));
    case Action::kCancel:
      return cancel_state(facts);
    case Action::kConfirm:
      if (facts.state.dialog == Dialog::kCalibration && facts.view.calibration) {
        const std::string why = why_not_confirmed(*facts.view.calibration);
        return why.empty() ? enabled() : disabled(why);
      }
      return only_if(can_confirm(facts), "nothing to confirm");
    default:
      return enabled();
  }
}

/// Behind an open dialog only what concerns it, and the program as a whole, goes on.
bool works_behind(Dialog dialog, Action action) {
  // The list of keys shows how all of them stand; pressing one there leaves it.
  if (dialog == Dialog::kNone || dialog == Dialog::kHelp) return true;
  switch (action) {
    case Action::kCancel:
    case Action::kConfirm:
    case Action::kQuit:
    case Action::kMute:
    case Action::kLarger:
    case Action::kSmaller:
      return true;
    case Action::kExport:
      return dialog == Dialog::kExport;
    case Action::kCase:
      return dialog == Dialog::kCase;
    case Action::kSettings:
      return dialog == Dialog::kSettings;
    case Action::kDevices:
      return dialog == Dialog::kDevices || dialog == Dialog::kSettings;
    case Action::kCheckDevices:
      return dialog == Dialog::kDevices;
    case Action::kCalibration:
      return dialog == Dialog::kCalibration || dialog == Dialog::kDevices ||
             dialog == Dialog::kSettings;
    case Action::kCalibrate:
    case Action::kCheckOnPlane:
    case Action::kCheckOnSphere:
    case Action::kPlaceBefore:
      return dialog == Dialog::kCalibration;
    default:
      return false;
  }
}

ActionState state_by_group(Action action, const Facts& facts) {
  switch (binding(action).group) {
    case ActionGroup::kScanning:
      return scanning_state(action, facts);
    case ActionGroup::kEditing:
      return editing_state(action, facts);
    case ActionGroup::kLooking:
      return looking_state(action, facts);
    case ActionGroup::kHand:
      return hand_state(action, facts);
    case ActionGroup::kCalibrating:
      return calibrating_state(action, facts);
    case ActionGroup::kProgram:
      break;
  }
  return program_state(action, facts);
}

}  // namespace

ActionState action_state(Action action, const AppView& view, const WindowState& state) {
  ActionState result = state_by_group(action, Facts{view, state});
  if (result.is_enabled && !works_behind(state.dialog, action)) {
    result = {false, result.is_on, "close the dialog first"};
  }
  return result;
}

}  // namespace flytri::ui
