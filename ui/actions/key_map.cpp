#include "ui/actions/key_map.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cassert>

namespace flytri::ui {
namespace {

constexpr auto kScanning = ActionGroup::kScanning;
constexpr auto kEditing = ActionGroup::kEditing;
constexpr auto kLooking = ActionGroup::kLooking;
constexpr auto kHand = ActionGroup::kHand;
constexpr auto kCalibrating = ActionGroup::kCalibrating;
constexpr auto kProgram = ActionGroup::kProgram;
constexpr int kControl = GLFW_MOD_CONTROL;
constexpr int kShift = GLFW_MOD_SHIFT;

constexpr std::array kBindings = {
    KeyBinding{Action::kScan, kScanning, "scan", "Scan or pause", GLFW_KEY_SPACE, 0, "Space",
               false},
    KeyBinding{Action::kFinish, kScanning, "finish", "Finish", GLFW_KEY_F, 0, "F", false},
    KeyBinding{Action::kNextPlace, kScanning, "next_place", "Next place to go on", GLFW_KEY_TAB, 0,
               "Tab", false},
    KeyBinding{Action::kNextHole, kScanning, "next_hole", "Next hole", GLFW_KEY_N, 0, "N", false},
    KeyBinding{Action::kStageUpper, kScanning, "upper", "Upper jaw", GLFW_KEY_F1, 0, "F1", false},
    KeyBinding{Action::kStageLower, kScanning, "lower", "Lower jaw", GLFW_KEY_F2, 0, "F2", false},
    KeyBinding{Action::kStageBite, kScanning, "bite", "Bite", GLFW_KEY_F3, 0, "F3", false},

    KeyBinding{Action::kUndo, kEditing, "undo", "Undo", GLFW_KEY_Z, 0, "Z", false},
    KeyBinding{Action::kRedo, kEditing, "redo", "Redo", GLFW_KEY_Y, 0, "Y", false},
    KeyBinding{Action::kTrim, kEditing, "trim", "Trim", GLFW_KEY_T, 0, "T", false},
    KeyBinding{Action::kLock, kEditing, "lock", "Lock", GLFW_KEY_K, 0, "K", false},
    KeyBinding{Action::kUnlock, kEditing, "unlock", "Unlock", GLFW_KEY_J, 0, "J", false},
    KeyBinding{Action::kBrushSmaller, kEditing, "brush_smaller", "Smaller brush",
               GLFW_KEY_LEFT_BRACKET, 0, "[", true},
    KeyBinding{Action::kBrushLarger, kEditing, "brush_larger", "Larger brush",
               GLFW_KEY_RIGHT_BRACKET, 0, "]", true},
    KeyBinding{Action::kMeasure, kEditing, "measure", "Measure", GLFW_KEY_M, 0, "M", false},
    KeyBinding{Action::kRemoveMeasurement, kEditing, "remove_measurement", "Remove last distance",
               GLFW_KEY_DELETE, 0, "Delete", false},

    KeyBinding{Action::kShading, kLooking, "shading", "Shape", GLFW_KEY_1, 0, "1", false},
    KeyBinding{Action::kTexture, kLooking, "texture", "Texture", GLFW_KEY_2, 0, "2", false},
    KeyBinding{Action::kCoverage, kLooking, "coverage", "Coverage", GLFW_KEY_3, 0, "3", false},
    KeyBinding{Action::kUncertainty, kLooking, "uncertainty", "Uncertainty", GLFW_KEY_4, 0, "4",
               false},
    KeyBinding{Action::kBlendLess, kLooking, "blend_less", "Less texture", GLFW_KEY_COMMA, 0, ",",
               true},
    KeyBinding{Action::kBlendMore, kLooking, "blend_more", "More texture", GLFW_KEY_PERIOD, 0, ".",
               true},
    KeyBinding{Action::kOcclusal, kLooking, "occlusal", "Occlusal view", GLFW_KEY_O, 0, "O", false},
    KeyBinding{Action::kBuccal, kLooking, "buccal", "Buccal view", GLFW_KEY_B, 0, "B", false},
    KeyBinding{Action::kLingual, kLooking, "lingual", "Lingual view", GLFW_KEY_L, 0, "L", false},
    KeyBinding{Action::kShowAll, kLooking, "show_all", "Show all", GLFW_KEY_HOME, 0, "Home", false},
    KeyBinding{Action::kZoomIn, kLooking, "zoom_in", "Nearer", GLFW_KEY_EQUAL, 0, "+", true},
    KeyBinding{Action::kZoomOut, kLooking, "zoom_out", "Farther", GLFW_KEY_MINUS, 0, "-", true},

    KeyBinding{Action::kLeft, kHand, "left", "Turn or move left", GLFW_KEY_LEFT, 0, "Left", true},
    KeyBinding{Action::kRight, kHand, "right", "Turn or move right", GLFW_KEY_RIGHT, 0, "Right",
               true},
    KeyBinding{Action::kUp, kHand, "up", "Turn or move up", GLFW_KEY_UP, 0, "Up", true},
    KeyBinding{Action::kDown, kHand, "down", "Turn or move down", GLFW_KEY_DOWN, 0, "Down", true},
    KeyBinding{Action::kTiltLeft, kHand, "tilt_left", "Tilt the sensor left", GLFW_KEY_LEFT, kShift,
               "Shift Left", true},
    KeyBinding{Action::kTiltRight, kHand, "tilt_right", "Tilt the sensor right", GLFW_KEY_RIGHT,
               kShift, "Shift Right", true},
    KeyBinding{Action::kTiltUp, kHand, "tilt_up", "Tilt the sensor up", GLFW_KEY_UP, kShift,
               "Shift Up", true},
    KeyBinding{Action::kTiltDown, kHand, "tilt_down", "Tilt the sensor down", GLFW_KEY_DOWN, kShift,
               "Shift Down", true},
    KeyBinding{Action::kHandNearer, kHand, "hand_nearer", "Sensor nearer", GLFW_KEY_PAGE_UP, 0,
               "Page up", true},
    KeyBinding{Action::kHandFarther, kHand, "hand_farther", "Sensor farther", GLFW_KEY_PAGE_DOWN, 0,
               "Page down", true},
    KeyBinding{Action::kHandMode, kHand, "hand_mode", "Sensor by hand", GLFW_KEY_W, 0, "W", false},
    KeyBinding{Action::kTakeAway, kHand, "take_away", "Take the sensor away", GLFW_KEY_A, 0, "A",
               false},

    KeyBinding{Action::kCalibration, kCalibrating, "calibration", "Calibration", GLFW_KEY_C, 0, "C",
               false},
    KeyBinding{Action::kCalibrate, kCalibrating, "calibrate", "Calibrate the sensor", GLFW_KEY_V, 0,
               "V", false},
    KeyBinding{Action::kCheckOnPlane, kCalibrating, "check_on_plane", "Check on a plane",
               GLFW_KEY_P, 0, "P", false},
    KeyBinding{Action::kCheckOnSphere, kCalibrating, "check_on_sphere", "Check on a sphere",
               GLFW_KEY_G, 0, "G", false},
    KeyBinding{Action::kPlaceBefore, kCalibrating, "place_before", "Last place again",
               GLFW_KEY_BACKSPACE, 0, "Backspace", false},

    KeyBinding{Action::kExport, kProgram, "export", "Export", GLFW_KEY_E, 0, "E", false},
    KeyBinding{Action::kCase, kProgram, "case", "Cases", GLFW_KEY_D, 0, "D", false},
    KeyBinding{Action::kSettings, kProgram, "settings", "Settings", GLFW_KEY_S, 0, "S", false},
    KeyBinding{Action::kDevices, kProgram, "devices", "Cameras and lights", GLFW_KEY_R, 0, "R",
               false},
    KeyBinding{Action::kCheckDevices, kProgram, "check_devices", "Check devices", GLFW_KEY_F5, 0,
               "F5", false},
    KeyBinding{Action::kHelp, kProgram, "help", "Keys", GLFW_KEY_H, 0, "H", false},
    KeyBinding{Action::kMute, kProgram, "mute", "Sound", GLFW_KEY_X, 0, "X", false},
    KeyBinding{Action::kLarger, kProgram, "larger", "Everything larger", GLFW_KEY_EQUAL, kControl,
               "Ctrl +", false},
    KeyBinding{Action::kSmaller, kProgram, "smaller", "Everything smaller", GLFW_KEY_MINUS,
               kControl, "Ctrl -", false},
    KeyBinding{Action::kConfirm, kProgram, "confirm", "Confirm", GLFW_KEY_ENTER, 0, "Enter", false},
    KeyBinding{Action::kCancel, kProgram, "cancel", "Cancel, close", GLFW_KEY_ESCAPE, 0, "Esc",
               false},
    KeyBinding{Action::kQuit, kProgram, "quit", "Quit", GLFW_KEY_Q, kControl, "Ctrl Q", false}};

}  // namespace

std::string_view to_string(ActionGroup group) {
  switch (group) {
    case ActionGroup::kScanning:
      return "Scanning";
    case ActionGroup::kEditing:
      return "Editing";
    case ActionGroup::kLooking:
      return "Looking";
    case ActionGroup::kHand:
      return "Hand and arrows";
    case ActionGroup::kCalibrating:
      return "Calibrating";
    case ActionGroup::kProgram:
      break;
  }
  return "Program";
}

std::span<const KeyBinding> key_map() { return kBindings; }

const KeyBinding& binding(Action action) {
  const auto* found = std::find_if(kBindings.begin(), kBindings.end(),
                                   [&](const KeyBinding& row) { return row.action == action; });
  assert(found != kBindings.end());
  return *found;
}

std::optional<Action> action_of(const KeyEvent& press) {
  const int modifiers = press.modifiers & (kControl | kShift);
  // A row that asks for Control or Shift goes first; else they do not matter: Ctrl Z is Z.
  for (const int wanted : {modifiers, 0}) {
    const auto* row = std::find_if(kBindings.begin(), kBindings.end(), [&](const KeyBinding& b) {
      return b.key == press.key && b.modifiers == wanted;
    });
    if (row == kBindings.end()) continue;
    if (press.is_repeat && !row->repeats) return std::nullopt;
    return row->action;
  }
  return std::nullopt;
}

}  // namespace flytri::ui
