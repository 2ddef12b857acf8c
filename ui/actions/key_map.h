/// @file  The one table of what the user can do: its key, and whether and how it stands now.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"
#include "ui/window/input.h"

namespace flytri::ui {

enum class Action {
  kScan,
  kUndo,
  kRedo,
  kTrim,
  kLock,
  kUnlock,
  kMeasure,
  kRemoveMeasurement,
  kFinish,
  kExport,
  kCase,
  kSettings,
  kDevices,
  kCheckDevices,
  kCalibration,
  kCalibrate,
  kCheckOnPlane,
  kCheckOnSphere,
  kPlaceBefore,
  kHelp,
  kCancel,
  kConfirm,
  kStageUpper,
  kStageLower,
  kStageBite,
  kShading,
  kTexture,
  kCoverage,
  kUncertainty,
  kBlendLess,
  kBlendMore,
  kOcclusal,
  kBuccal,
  kLingual,
  kShowAll,
  kZoomIn,
  kZoomOut,
  kLeft,
  kRight,
  kUp,
  kDown,
  kNextHole,
  kNextPlace,
  kBrushSmaller,
  kBrushLarger,
  kHandMode,
  kTakeAway,
  kHandNearer,
  kHandFarther,
  kTiltLeft,
  kTiltRight,
  kTiltUp,
  kTiltDown,
  kMute,
  kLarger,
  kSmaller,
  kQuit
};

/// Where an action stands in the list of keys.
enum class ActionGroup { kScanning, kEditing, kLooking, kHand, kCalibrating, kProgram };
[[nodiscard]] std::string_view to_string(ActionGroup group);

/// A row of the table.
struct KeyBinding {
  Action action;
  ActionGroup group;
  const char* id;        ///< of its button, for tests: "scan"
  const char* name;      ///< what it does, in the user's words
  int key;               ///< GLFW_KEY_*
  int modifiers;         ///< GLFW_MOD_CONTROL, GLFW_MOD_SHIFT or 0
  const char* key_text;  ///< as it is printed on a keyboard
  bool repeats;          ///< while the key is held
};

/// All of them, in the order in which they are shown.
[[nodiscard]] std::span<const KeyBinding> key_map();
[[nodiscard]] const KeyBinding& binding(Action action);
/// What a key does. Control and Shift count where a row of the table asks for them.
[[nodiscard]] std::optional<Action> action_of(const KeyEvent& press);

/// What fits the column of the keys' list.
constexpr std::size_t kLongestStanding = 24;

/// How an action stands.
struct ActionState {
  bool is_enabled = true;
  bool is_on = false;  ///< a tool in hand, a mode chosen
  std::string text;    ///< why it is disabled, or how it stands; at most kLongestStanding
};
[[nodiscard]] ActionState action_state(Action action, const AppView& view,
                                       const WindowState& state);

}  // namespace flytri::ui
