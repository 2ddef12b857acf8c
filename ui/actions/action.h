/// @file  The names of everything that the user can do.
///
/// To add an action: name it here, in its group, and add its row to the file of that group, such as
/// scanning_actions.cpp, and its name to ui/text/action_texts.h. Without these the program does not
/// compile. A button for it is one line in a panel.
#pragma once

#include <array>
#include <cstddef>

#include "ui/text/texts.h"

namespace flytri::ui {

/// In the order of the list of keys.
enum class Action {
  // Scanning
  kScan,
  kFinish,
  kNextPlace,
  kNextHole,
  kStageUpper,
  kStageLower,
  kStageBite,
  kStageBite2,
  kStageFace,
  kStages,
  // Editing
  kUndo,
  kRedo,
  kTrim,
  kLock,
  kUnlock,
  kBrushSmaller,
  kBrushLarger,
  kMeasure,
  kMeasureDistance,
  kMeasureAngle,
  kSection,
  kUndercut,
  kMargin,
  kRemoveMeasurement,
  kClearStage,
  kBringBack,
  // Looking
  kShading,
  kTexture,
  kCoverage,
  kUncertainty,
  kShowCrossed,
  kBlendLess,
  kBlendMore,
  kOcclusal,
  kBuccal,
  kLingual,
  kRightSide,
  kLeftSide,
  kShowAll,
  kJaws,
  kClearance,
  kOcclusalPlane,
  kAutomaticPlane,
  kZoomIn,
  kZoomOut,
  // Hand
  kLeft,
  kRight,
  kUp,
  kDown,
  kTiltLeft,
  kTiltRight,
  kTiltUp,
  kTiltDown,
  kHandNearer,
  kHandFarther,
  kHandMode,
  kLiftSensor,
  kRecord,
  // Calibrating
  kCalibration,
  kCalibrate,
  kCheckOnPlane,
  kCheckOnSphere,
  kPreviousPlace,
  kSetUp,
  kBeginSetup,
  kVirtualSensor,
  // Program
  kExport,
  kOpenExportFolder,
  kCase,
  kSettings,
  kDevices,
  kCheckDevices,
  kHelp,
  kMute,
  kFullScreen,
  kLarger,
  kSmaller,
  kConfirm,
  kCancel,
  kQuit,

  kCount  ///< not an action: how many there are
};

/// The headings of the list of keys.
enum class ActionGroup { kScanning, kEditing, kLooking, kHand, kCalibrating, kProgram };

/// The first action of each group; a group ends where the next one begins.
inline constexpr std::array kFirstOfGroup = {Action::kScan, Action::kUndo,        Action::kShading,
                                             Action::kLeft, Action::kCalibration, Action::kExport,
                                             Action::kCount};

[[nodiscard]] constexpr std::size_t index_of(Action action) {
  return static_cast<std::size_t>(action);
}
[[nodiscard]] constexpr std::size_t first_of(ActionGroup group) {
  return index_of(kFirstOfGroup[static_cast<std::size_t>(group)]);
}
[[nodiscard]] constexpr std::size_t end_of(ActionGroup group) {
  return index_of(kFirstOfGroup[static_cast<std::size_t>(group) + 1]);
}
static_assert(index_of(kFirstOfGroup.front()) == 0, "an action stands before the first group");

/// The heading of a group.
[[nodiscard]] Text heading_of(ActionGroup group);

}  // namespace flytri::ui
