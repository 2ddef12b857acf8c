/// @file  The arrow keys, and the hand that moves the simulated sensor.
#include <GLFW/glfw3.h>

#include "ui/actions/action_groups.h"

namespace flytri::ui {
namespace {

constexpr double kMoveShare = 0.03;  ///< of the volume's width or depth, for a press
constexpr double kTilt_rad = 0.035;  ///< of the sensor, for a press
/// Of the picture's height: the drag that turns the camera as much as a press does.
constexpr double kDragShare = 0.04;

ActionState arrow_state(const Situation& now) {
  return enabled(now.steers_by_hand() ? Text::kMovesSensor : Text::kTurnsView);
}

/// @param kRight, kDown  direction in the picture
template <int kRight, int kDown>
void turn_or_move(const ActionRunner& run) {
  const Vec2 towards(kRight, kDown);
  if (run.view.source.hand && !run.view.source.hand->follows_path) {
    const Vec2 move_mm = kMoveShare * run.view.volume_mm.x() * towards;
    return run.send(SteerHand{{move_mm.x(), move_mm.y(), 0.0}, Vec3::Zero()});
  }
  CameraState& camera = run.state.view;
  camera.follows_scan = false;
  const Vec2 drag_px = kDragShare * camera.picture.height_px * towards;
  camera.camera.orbit(drag_px.x(), drag_px.y(), camera.picture);
}

ActionState steer_state(const Situation& now) {
  return only_if(now.steers_by_hand(), Text::kByHandIsOff);
}

template <int kRight, int kDown>
void tilt(const ActionRunner& run) {
  run.send(SteerHand{Vec3::Zero(), kTilt_rad * Vec3(-kDown, kRight, 0.0)});
}

/// @param kSign  1: closer to the teeth
template <int kSign>
void approach(const ActionRunner& run) {
  run.send(SteerHand{{0.0, 0.0, kSign * kMoveShare * run.view.volume_mm.z()}, Vec3::Zero()});
}

ActionState hand_mode_state(const Situation& now) {
  if (!now.view.source.hand) return disabled(Text::kSimulatedOnly);
  return chosen(now.steers_by_hand());
}

void toggle_hand_mode(const ActionRunner& run) {
  run.send(FollowPath{!run.view.source.hand->follows_path});
}

ActionState lift_state(const Situation& now) {
  if (!now.view.source.hand) return disabled(Text::kSimulatedOnly);
  return chosen(now.view.source.hand->is_taken_away, Text::kLifted);
}

void lift_or_return(const ActionRunner& run) {
  run.send(TakeSensorAway{!run.view.source.hand->is_taken_away});
}

ActionState record_state(const Situation& now) {
  if (!now.view.recording.is_possible) return disabled(Text::kRecordingPlayed);
  return chosen(now.view.recording.is_on, Text::kIsRecording);
}

/// A folder that was typed is remembered.
void record(const ActionRunner& run) {
  const RecordingForm& form = run.state.recording_form;
  const std::string folder = form.is_edited ? form.folder : run.view.recording.folder;
  const bool is_on = !run.view.recording.is_on;
  if (is_on && form.is_edited) {
    Settings settings = run.view.settings;
    settings.recording_folder = folder;
    run.send(ChangeSettings{settings});
  }
  run.send(RecordFrames{is_on, folder});
}

constexpr std::array kHandActions = {ActionRow{.action = Action::kLeft,
                                               .id = "left",
                                               .name = Text::kTurnLeft,
                                               .shortcut = {GLFW_KEY_LEFT, 0, true},
                                               .state = arrow_state,
                                               .perform = turn_or_move<-1, 0>},
                                     ActionRow{.action = Action::kRight,
                                               .id = "right",
                                               .name = Text::kTurnRight,
                                               .shortcut = {GLFW_KEY_RIGHT, 0, true},
                                               .state = arrow_state,
                                               .perform = turn_or_move<1, 0>},
                                     ActionRow{.action = Action::kUp,
                                               .id = "up",
                                               .name = Text::kTurnUp,
                                               .shortcut = {GLFW_KEY_UP, 0, true},
                                               .state = arrow_state,
                                               .perform = turn_or_move<0, -1>},
                                     ActionRow{.action = Action::kDown,
                                               .id = "down",
                                               .name = Text::kTurnDown,
                                               .shortcut = {GLFW_KEY_DOWN, 0, true},
                                               .state = arrow_state,
                                               .perform = turn_or_move<0, 1>},
                                     ActionRow{.action = Action::kTiltLeft,
                                               .id = "tilt_left",
                                               .name = Text::kTiltLeft,
                                               .shortcut = {GLFW_KEY_LEFT, GLFW_MOD_SHIFT, true},
                                               .state = steer_state,
                                               .perform = tilt<-1, 0>},
                                     ActionRow{.action = Action::kTiltRight,
                                               .id = "tilt_right",
                                               .name = Text::kTiltRight,
                                               .shortcut = {GLFW_KEY_RIGHT, GLFW_MOD_SHIFT, true},
                                               .state = steer_state,
                                               .perform = tilt<1, 0>},
                                     ActionRow{.action = Action::kTiltUp,
                                               .id = "tilt_up",
                                               .name = Text::kTiltUp,
                                               .shortcut = {GLFW_KEY_UP, GLFW_MOD_SHIFT, true},
                                               .state = steer_state,
                                               .perform = tilt<0, -1>},
                                     ActionRow{.action = Action::kTiltDown,
                                               .id = "tilt_down",
                                               .name = Text::kTiltDown,
                                               .shortcut = {GLFW_KEY_DOWN, GLFW_MOD_SHIFT, true},
                                               .state = steer_state,
                                               .perform = tilt<0, 1>},
                                     ActionRow{.action = Action::kHandNearer,
                                               .id = "hand_nearer",
                                               .name = Text::kMoveCloser,
                                               .shortcut = {GLFW_KEY_PAGE_UP, 0, true},
                                               .state = steer_state,
                                               .perform = approach<1>},
                                     ActionRow{.action = Action::kHandFarther,
                                               .id = "hand_farther",
                                               .name = Text::kMoveAway,
                                               .shortcut = {GLFW_KEY_PAGE_DOWN, 0, true},
                                               .state = steer_state,
                                               .perform = approach<-1>},
                                     ActionRow{.action = Action::kHandMode,
                                               .id = "hand_mode",
                                               .name = Text::kMoveByHand,
                                               .shortcut = {GLFW_KEY_W},
                                               .state = hand_mode_state,
                                               .perform = toggle_hand_mode},
                                     ActionRow{.action = Action::kLiftSensor,
                                               .id = "lift_sensor",
                                               .name = Text::kLiftOrReturn,
                                               .shortcut = {GLFW_KEY_A},
                                               .state = lift_state,
                                               .perform = lift_or_return},
                                     ActionRow{.action = Action::kRecord,
                                               .id = "record",
                                               .name = Text::kRecordRawImages,
                                               .shortcut = {GLFW_KEY_R, GLFW_MOD_CONTROL},
                                               .state = record_state,
                                               .perform = record,
                                               .works_in = in(Dialog::kSettings)}};
static_assert(lists_all_of(ActionGroup::kHand, kHandActions));

}  // namespace

std::span<const ActionRow> hand_actions() { return kHandActions; }

}  // namespace flytri::ui
