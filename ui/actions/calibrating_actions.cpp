/// @file  Calibrate the sensor, check its calibration, or set up another one.
#include <GLFW/glfw3.h>

#include "ui/actions/action_groups.h"

namespace flytri::ui {
namespace {

ActionState panel_state(const Situation& now) {
  if (!now.view.calibration) return disabled(Text::kNotForRecordings);
  if (!now.may_leave()) return disabled(Text::kFinishing);
  const bool is_open = now.state.dialog == Dialog::kCalibration;
  return is_open && now.is_calibrating() ? disabled(Text::kRunning) : enabled();
}

/// What all tasks have in common.
ActionState task_state(const Situation& now) {
  if (!now.view.calibration) return disabled(Text::kNotForRecordings);
  if (now.state.dialog != Dialog::kCalibration) return disabled(Text::kOpenCalibration);
  return only_if(!now.is_calibrating(), Text::kRunning);
}

ActionState check_on_plane_state(const Situation& now) {
  ActionState task = task_state(now);
  if (!task.is_enabled) return task;
  return only_if(now.view.calibration->calibration != nullptr, Text::kNoCalibration);
}

ActionState check_on_sphere_state(const Situation& now) {
  ActionState check = check_on_plane_state(now);
  if (!check.is_enabled) return check;
  if (now.view.calibration->is_simulated) return disabled(Text::kRealSensorOnly);
  const auto diameter_mm = typed_length_mm(now.state.calibration_form.sphere_diameter_mm);
  return only_if(diameter_mm.has_value(), Text::kEnterDiameter);
}

template <CalibrationTask kTask>
void begin_calibration(const ActionRunner& run) {
  const CalibrationForm& form = run.state.calibration_form;
  run.send(BeginCalibration{kTask, form.is_edited ? form.folder : run.view.calibration->folder,
                            typed_length_mm(form.sphere_diameter_mm).value_or(0.0), form.note});
}

ActionState previous_place_state(const Situation& now) {
  if (!now.view.calibration) return disabled(Text::kNotForRecordings);
  if (!now.is_calibrating()) return disabled(Text::kNotCalibrating);
  const RunningCalibration& running = *now.view.calibration->running;
  const bool waits =
      running.step == CalibrationStep::kTarget || running.step == CalibrationStep::kRefused;
  return only_if(waits && previous_place(running), Text::kNoImagesYet);
}

void retake_previous_place(const ActionRunner& run) {
  run.send(RetakeCalibrationPlace{*previous_place(*run.view.calibration->running)});
}

ActionState set_up_state(const Situation& now) {
  if (!now.may_leave()) return disabled(Text::kFinishing);
  if (now.is_calibrating()) return disabled(Text::kRunning);
  return only_if(!now.is_setting_up() || now.state.dialog != Dialog::kSetup, Text::kRunning);
}

/// What both ways to another sensor have in common.
ActionState other_sensor_state(const Situation& now) {
  if (now.state.dialog != Dialog::kSetup) return disabled(Text::kOpenSetup);
  return only_if(!now.is_setting_up(), Text::kRunning);
}

ActionState virtual_sensor_state(const Situation& now) {
  ActionState state = other_sensor_state(now);
  if (!state.is_enabled) return state;
  if (!now.view.setup.why_not_used.empty()) return disabled(now.view.setup.why_not_used);
  return only_if(now.view.setup.has_rig, Text::kInUse);
}

constexpr Dialogs kInPanel = in(Dialog::kCalibration), kInSetup = in(Dialog::kSetup);

constexpr std::array kCalibratingActions = {
    ActionRow{.action = Action::kCalibration,
              .id = "calibration",
              .name = Text::kCalibration,
              .shortcut = {GLFW_KEY_C},
              .state = panel_state,
              .perform = toggle_dialog<Dialog::kCalibration>,
              .works_in = kInPanel | in(Dialog::kDevices) | in(Dialog::kSettings)},
    ActionRow{.action = Action::kCalibrate,
              .id = "calibrate",
              .name = Text::kCalibrateSensor,
              .shortcut = {GLFW_KEY_V},
              .state = task_state,
              .perform = begin_calibration<CalibrationTask::kCalibrate>,
              .works_in = kInPanel},
    ActionRow{.action = Action::kCheckOnPlane,
              .id = "check_on_plane",
              .name = Text::kCheckOnPlane,
              .shortcut = {GLFW_KEY_P},
              .state = check_on_plane_state,
              .perform = begin_calibration<CalibrationTask::kCheckOnPlane>,
              .works_in = kInPanel},
    ActionRow{.action = Action::kCheckOnSphere,
              .id = "check_on_sphere",
              .name = Text::kCheckOnSphere,
              .shortcut = {GLFW_KEY_G},
              .state = check_on_sphere_state,
              .perform = begin_calibration<CalibrationTask::kCheckOnSphere>,
              .works_in = kInPanel},
    ActionRow{.action = Action::kPreviousPlace,
              .id = "previous_place",
              .name = Text::kRepeatPlace,
              .shortcut = {GLFW_KEY_BACKSPACE},
              .state = previous_place_state,
              .perform = retake_previous_place,
              .works_in = kInPanel},
    ActionRow{.action = Action::kSetUp,
              .id = "set_up",
              .name = Text::kSetUpSensor,
              .shortcut = {GLFW_KEY_C, GLFW_MOD_SHIFT},
              .state = set_up_state,
              .perform = toggle_dialog<Dialog::kSetup>,
              .works_in = kInSetup | in(Dialog::kDevices) | in(Dialog::kSettings)},
    ActionRow{.action = Action::kBeginSetup,
              .id = "begin_setup",
              .name = Text::kBeginSetup,
              .shortcut = {GLFW_KEY_V, GLFW_MOD_SHIFT},
              .state = other_sensor_state,
              .perform = send<BeginSetup>,
              .works_in = kInSetup,
              .is_listed = false},
    ActionRow{.action = Action::kVirtualSensor,
              .id = "virtual_sensor",
              .name = Text::kUseVirtualSensor,
              .shortcut = {GLFW_KEY_P, GLFW_MOD_SHIFT},
              .state = virtual_sensor_state,
              .perform = send<UseVirtualSensor>,
              .works_in = kInSetup,
              .is_listed = false}};
static_assert(lists_all_of(ActionGroup::kCalibrating, kCalibratingActions));

}  // namespace

std::span<const ActionRow> calibrating_actions() { return kCalibratingActions; }

}  // namespace flytri::ui
