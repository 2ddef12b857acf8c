/// @file  Dialogs, settings, confirm, cancel and quit.
#include <GLFW/glfw3.h>

#include <algorithm>

#include "ui/actions/action_groups.h"
#include "ui/state/export_target.h"
#include "ui/state/review_look.h"

namespace flytri::ui {
namespace {

constexpr double kScaleStep = 0.125;

ActionState export_state(const Situation& now) {
  return only_if(now.has_surface() && now.may_leave(), Text::kNothingToExport);
}

ActionState devices_state(const Situation& now) {
  if (!now.view.devices) return disabled(Text::kRealDevicesOnly);
  return now.view.devices->problems.empty() ? enabled() : enabled(Text::kProblemsFound);
}

ActionState check_devices_state(const Situation& now) {
  if (!now.view.devices) return disabled(Text::kRealDevicesOnly);
  return only_if(!now.view.devices->is_checking, Text::kRunning);
}

ActionState mute_state(const Situation& now) {
  return enabled(now.view.settings.is_muted ? Text::kMuted : Text::kOn);
}

void toggle_mute(const ActionRunner& run) {
  Settings settings = run.view.settings;
  settings.is_muted = !settings.is_muted;
  run.send(ChangeSettings{settings});
}

ActionState full_screen_state(const Situation& now) {
  const bool is_on = now.view.settings.is_full_screen;
  return chosen(is_on, is_on ? Text::kOn : Text::kOff);
}

void toggle_full_screen(const ActionRunner& run) {
  Settings settings = run.view.settings;
  settings.is_full_screen = !settings.is_full_screen;
  run.send(ChangeSettings{settings});
}

ActionState scale_state(const Situation& now) {
  return enabled(percent_text(now.view.settings.user_scale));
}

void change_scale(const ActionRunner& run, double step) {
  Settings settings = run.view.settings;
  settings.user_scale = std::clamp(settings.user_scale + step, 0.75, 2.0);
  run.send(ChangeSettings{settings});
}

/// Typing needs both hands: scanning pauses.
void toggle_cases(const ActionRunner& run) {
  if (run.state.dialog != Dialog::kCase && run.view.is_scanning) run.send(PauseScan{});
  run.toggle(Dialog::kCase);
  // It opens where the damage is told.
  if (run.view.file.damaged) run.state.case_form = CaseForm();
}

/// Whether the main button of the calibration panel does something now.
ActionState confirm_calibration_state(const CalibrationState& calibration) {
  if (!calibration.running) return disabled(Text::kChooseTaskFirst);
  switch (calibration.running->step) {
    case CalibrationStep::kTarget:
      return enabled();
    case CalibrationStep::kDone:
      if (calibration.running->task != CalibrationTask::kCalibrate) return disabled(Text::kDone);
      if (calibration.why_not_used.empty()) return enabled();
      return disabled(calibration.why_not_used);
    case CalibrationStep::kRefused:
      return disabled(Text::kChoosePlace);
    case CalibrationStep::kFailed:
      return disabled(Text::kFailed);
    case CalibrationStep::kOpening:
    case CalibrationStep::kTaking:
    case CalibrationStep::kComputing:
      break;
  }
  return disabled(Text::kPleaseWait);
}

/// Whether the main button of the setup panel does something now.
ActionState confirm_setup_state(const SetupState& setup) {
  if (!setup.running) return disabled(Text::kChooseTaskFirst);
  switch (setup.running->step) {
    case SetupStep::kAsking:
      return enabled();
    case SetupStep::kDone:
      return setup.why_not_used.empty() ? enabled() : disabled(setup.why_not_used);
    case SetupStep::kFailed:
      return disabled(Text::kFailed);
    case SetupStep::kWorking:
      break;
  }
  return disabled(Text::kPleaseWait);
}

bool can_be_rescued(const CaseState& file) {
  return file.damaged && file.damaged->survey && !file.damaged->is_copying;
}

bool can_confirm(const Situation& now) {
  const ExportForm& form = now.state.export_form;
  const CaseForm& case_form = now.state.case_form;
  switch (now.state.dialog) {
    case Dialog::kExport:
      return !now.view.exports.is_running && !form.name.empty() &&
             asks_for_files(export_target(now.view, form));
    case Dialog::kCase:
      if (problem_of(case_form)) return false;
      if (case_form.tab == CaseTab::kFields) return !now.view.file.is_read_only;
      if (case_form.tab == CaseTab::kDamage && !can_be_rescued(now.view.file)) return false;
      return now.may_leave() && !now.view.file.is_moving && !now.view.file.is_opening;
    case Dialog::kNone:
      return can_keep_margin(now.view, now.state);
    case Dialog::kHelp:
    case Dialog::kSettings:
    case Dialog::kDevices:
    case Dialog::kCalibration:
    case Dialog::kSetup:
    case Dialog::kQuestion:
    case Dialog::kStages:
      break;
  }
  return true;
}

ActionState confirm_state(const Situation& now) {
  if (now.state.dialog == Dialog::kCalibration && now.view.calibration) {
    return confirm_calibration_state(*now.view.calibration);
  }
  if (now.state.dialog == Dialog::kSetup) return confirm_setup_state(now.view.setup);
  return only_if(can_confirm(now), Text::kNothingToConfirm);
}

ActionState open_export_folder_state(const Situation& now) {
  return only_if(!now.view.exports.written.empty(), Text::kNoExportYet);
}

Export requested_export(const AppView& view, const ExportForm& form) {
  Export command = {export_target(view, form), {}};
  if (is_replacing(view, form)) command.replaced = view.exports.existing;
  return command;
}

Command requested_case(const CaseForm& form) {
  if (form.discards) return DiscardCase{form.path};
  switch (form.tab) {
    case CaseTab::kFields:
      return SetCaseFields{form.fields};
    case CaseTab::kDamage:
      return SaveRescueCopy{form.path};
    case CaseTab::kNew:
      return NewCase{form.path, form.passphrase, form.fields};
    case CaseTab::kOpen:
      break;
  }
  return OpenCase{form.path, form.passphrase};
}

void confirm_calibration(const ActionRunner& run) {
  const bool is_done = run.view.calibration->running->step == CalibrationStep::kDone;
  run.send(is_done ? Command(UseCalibration{}) : Command(TakeCalibrationImages{}));
}

/// A named case is left for another one; the scan of an unnamed one goes on in the new one.
bool leaves_case(const AppView& view, const CaseForm& form) {
  if (form.discards) return false;
  return form.tab == CaseTab::kOpen || (form.tab == CaseTab::kNew && !view.file.is_unnamed);
}

void quit(const ActionRunner& run) {
  if (has_unsaved(run.view)) return run.ask(QuestionKind::kLeaveUnsaved, Quit{});
  if (run.view.exports.is_running) return run.ask(QuestionKind::kLeaveExport, Quit{});
  run.send(Quit{});
}

void confirm_case(const ActionRunner& run) {
  CaseForm& form = run.state.case_form;
  if (has_unsaved(run.view) && leaves_case(run.view, form)) {
    run.ask(QuestionKind::kLeaveUnsaved, requested_case(form));
  } else {
    run.send(requested_case(form));
  }
  form.passphrase.clear();
  form.passphrase_again.clear();
  if (form.discards) {
    form.discards = false;
    form.path.clear();
    return;
  }
  form.is_asked = true;
  // A new or opened case keeps the dialog until it is there: opening may fail, or ask for a
  // passphrase.
  if (form.tab == CaseTab::kFields) run.state.dialog = Dialog::kNone;
}

/// Of a case that is to be opened after all, its dialog says what becomes of it.
void confirm_question(const ActionRunner& run) {
  const Command& command = run.state.question.command;
  const bool is_case =
      std::holds_alternative<OpenCase>(command) || std::holds_alternative<NewCase>(command);
  run.send(command);
  run.state.dialog = is_case ? Dialog::kCase : Dialog::kNone;
}

void keep_margin(const ActionRunner& run) {
  run.send(KeepMargin{});
  run.state.review.margin_mm.clear();
}

/// Gives the suggested answer, or takes the sensor into use, which then has to be calibrated.
void confirm_setup(const ActionRunner& run) {
  const RunningSetup& running = *run.view.setup.running;
  if (running.step == SetupStep::kAsking) {
    const SetupQuestion& question = running.question;
    return run.send(AnswerSetup{question.number, question.suggested});
  }
  run.send(UseSetup{});
  run.state.dialog = Dialog::kCalibration;
}

void confirm(const ActionRunner& run) {
  switch (run.state.dialog) {
    case Dialog::kCalibration:
      return confirm_calibration(run);
    case Dialog::kSetup:
      return confirm_setup(run);
    case Dialog::kExport:
      // The dialog stays open: it shows what was written.
      return run.send(requested_export(run.view, run.state.export_form));
    case Dialog::kCase:
      return confirm_case(run);
    case Dialog::kQuestion:
      return confirm_question(run);
    case Dialog::kNone:
      return keep_margin(run);
    case Dialog::kHelp:
    case Dialog::kSettings:
    case Dialog::kDevices:
    case Dialog::kStages:
      break;
  }
  run.state.dialog = Dialog::kNone;
}

/// What Cancel does now. Its state and what it does follow from the same list.
enum class CancelTarget { kCalibration, kSetup, kDialog, kTool, kFinishing, kHole, kNothing };

CancelTarget cancel_target(const Situation& now) {
  if (now.state.dialog == Dialog::kCalibration && now.is_calibrating()) {
    return CancelTarget::kCalibration;
  }
  if (now.state.dialog == Dialog::kSetup && now.is_setting_up()) return CancelTarget::kSetup;
  if (now.state.dialog != Dialog::kNone) return CancelTarget::kDialog;
  if (now.state.tool != Tool::kNone) return CancelTarget::kTool;
  if (now.is_finishing()) return CancelTarget::kFinishing;
  return now.state.selected_hole ? CancelTarget::kHole : CancelTarget::kNothing;
}

ActionState cancel_state(const Situation& now) {
  switch (cancel_target(now)) {
    case CancelTarget::kCalibration:
      return enabled(Text::kStopsCalibration);
    case CancelTarget::kSetup:
      return enabled(Text::kStopsSetup);
    case CancelTarget::kDialog:
      return enabled(Text::kClosesDialog);
    case CancelTarget::kTool:
      return enabled(Text::kPutsToolAway);
    case CancelTarget::kFinishing:
      return enabled(Text::kStopsFinishing);
    case CancelTarget::kHole:
      return enabled(Text::kDeselectsHole);
    case CancelTarget::kNothing:
      break;
  }
  return disabled(Text::kNothingToCancel);
}

void cancel(const ActionRunner& run) {
  switch (cancel_target({run.view, run.state})) {
    case CancelTarget::kCalibration:
      return run.send(EndCalibration{});
    case CancelTarget::kSetup:
      return run.send(EndSetup{});
    case CancelTarget::kDialog:
      if (run.state.dialog == Dialog::kCase && run.state.case_form.discards) {
        run.state.case_form.discards = false;
        return;
      }
      run.state.dialog = Dialog::kNone;
      return;
    case CancelTarget::kTool:
      return run.toggle(run.state.tool);
    case CancelTarget::kFinishing:
      return run.send(CancelFinish{});
    case CancelTarget::kHole:
      run.state.selected_hole.reset();
      return;
    case CancelTarget::kNothing:
      break;
  }
}

constexpr std::array kProgramActions = {
    ActionRow{.action = Action::kExport,
              .id = "export",
              .name = Text::kExport,
              .shortcut = {GLFW_KEY_E},
              .state = export_state,
              .perform = toggle_dialog<Dialog::kExport>,
              .works_in = in(Dialog::kExport)},
    ActionRow{.action = Action::kOpenExportFolder,
              .id = "open_folder",
              .name = Text::kOpenExportFolder,
              .shortcut = {GLFW_KEY_O, GLFW_MOD_CONTROL},
              .state = open_export_folder_state,
              .perform = send<OpenExportFolder>,
              .works_in = in(Dialog::kExport)},
    ActionRow{.action = Action::kCase,
              .id = "case",
              .name = Text::kCases,
              .shortcut = {GLFW_KEY_D},
              .perform = toggle_cases,
              .works_in = in(Dialog::kCase)},
    ActionRow{.action = Action::kSettings,
              .id = "settings",
              .name = Text::kSettings,
              .shortcut = {GLFW_KEY_S},
              .perform = toggle_dialog<Dialog::kSettings>,
              .works_in = in(Dialog::kSettings)},
    ActionRow{.action = Action::kDevices,
              .id = "devices",
              .name = Text::kCamerasAndLights,
              .shortcut = {GLFW_KEY_R},
              .state = devices_state,
              .perform = toggle_dialog<Dialog::kDevices>,
              .works_in = in(Dialog::kDevices) | in(Dialog::kSettings)},
    ActionRow{.action = Action::kCheckDevices,
              .id = "check_devices",
              .name = Text::kCheckDevices,
              .shortcut = {GLFW_KEY_F5},
              .state = check_devices_state,
              .perform = send<CheckDevices>,
              .works_in = in(Dialog::kDevices)},
    ActionRow{.action = Action::kHelp,
              .id = "help",
              .name = Text::kKeys,
              .shortcut = {GLFW_KEY_H},
              .perform = toggle_dialog<Dialog::kHelp>},
    ActionRow{.action = Action::kMute,
              .id = "mute",
              .name = Text::kSound,
              .shortcut = {GLFW_KEY_X},
              .state = mute_state,
              .perform = toggle_mute,
              .works_in = kEachDialog},
    ActionRow{.action = Action::kFullScreen,
              .id = "full_screen",
              .name = Text::kFullScreen,
              .shortcut = {GLFW_KEY_F11},
              .state = full_screen_state,
              .perform = toggle_full_screen,
              .works_in = kEachDialog},
    ActionRow{.action = Action::kLarger,
              .id = "larger",
              .name = Text::kLargerInterface,
              .shortcut = {GLFW_KEY_EQUAL, GLFW_MOD_CONTROL},
              .state = scale_state,
              .perform = [](const ActionRunner& run) { change_scale(run, kScaleStep); },
              .works_in = kEachDialog},
    ActionRow{.action = Action::kSmaller,
              .id = "smaller",
              .name = Text::kSmallerInterface,
              .shortcut = {GLFW_KEY_MINUS, GLFW_MOD_CONTROL},
              .state = scale_state,
              .perform = [](const ActionRunner& run) { change_scale(run, -kScaleStep); },
              .works_in = kEachDialog},
    ActionRow{.action = Action::kConfirm,
              .id = "confirm",
              .name = Text::kConfirm,
              .shortcut = {GLFW_KEY_ENTER},
              .state = confirm_state,
              .perform = confirm,
              .works_in = kEachDialog},
    ActionRow{.action = Action::kCancel,
              .id = "cancel",
              .name = Text::kCancelOrClose,
              .shortcut = {GLFW_KEY_ESCAPE},
              .state = cancel_state,
              .perform = cancel,
              .works_in = kEachDialog},
    ActionRow{.action = Action::kQuit,
              .id = "quit",
              .name = Text::kQuit,
              .shortcut = {GLFW_KEY_Q, GLFW_MOD_CONTROL},
              .perform = quit,
              .works_in = kEachDialog}};
static_assert(lists_all_of(ActionGroup::kProgram, kProgramActions));

}  // namespace

std::span<const ActionRow> program_actions() { return kProgramActions; }

}  // namespace flytri::ui
