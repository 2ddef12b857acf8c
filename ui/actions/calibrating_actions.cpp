/// @file  Calibrate the sensor, or check its calibration.
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
  return only_if(now.view.calibration->has_calibration, Text::kNoCalibration);
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
                            typed_length_mm(form.sphere_diameter_mm).value_or(0.0)});
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

constexpr Dialogs kInPanel = in(Dialog::kCalibration);

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
              .works_in = kInPanel}};
static_assert(lists_all_of(ActionGroup::kCalibrating, kCalibratingActions));

}  // namespace

std::span<const ActionRow> calibrating_actions() { return kCalibratingActions; }

}  // namespace flytri::ui
