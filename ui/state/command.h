/// @file  What the user wants done: the window returns commands, the program carries them out.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/editing/edits.h"
#include "ui/state/app_view.h"

namespace flytri::ui {

/// Starts scanning, or goes on after a pause or after finishing.
struct StartScan {};
struct PauseScan {};
struct Undo {};
struct Redo {};
/// One stroke of the brush. The program sets the time it is made at.
struct EditSurface {
  editing::EditKind kind = editing::EditKind::kTrim;
  std::vector<editing::BrushDab> dabs;  ///< at least 1, world frame
};
struct AddMeasurement {
  io::Measurement measurement;
};
struct RemoveMeasurement {
  std::size_t index = 0;  ///< in AppView::measurements
};
struct Finish {};
struct CancelFinish {};
/// Takes the result away and goes on scanning.
struct ResumeScan {};
struct ChooseReentry {
  std::size_t index = 0;  ///< in ScanSnapshot::reentry
};
struct SelectStage {
  io::ScanStage stage = io::ScanStage::kUpper;
};
/// Writes what is shown.
struct Export {
  std::string folder;
  std::string name;                       ///< without extension
  std::vector<std::string_view> formats;  ///< at least 1 extension, as in io::model_formats()
};
struct NewCase {
  std::string path;
  std::string passphrase;  ///< empty: not encrypted
  io::CaseFields fields;
};
struct OpenCase {
  std::string path;
  std::string passphrase;
};
struct SetCaseFields {
  io::CaseFields fields;
};
/// Moves the simulated hand, in the sensor frame: as the live image shows it, x right, y down,
/// z away from the hand.
struct SteerHand {
  Vec3 move_mm = Vec3::Zero();
  Vec3 turn_rad = Vec3::Zero();  ///< rotation vector
};
/// Moves the simulated hand to where a ray meets the object, world frame. Where the ray meets
/// nothing, nothing happens.
struct PointHand {
  Vec3 origin_mm = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();  ///< unit
};
/// The simulated hand follows its path, or else the pointer.
struct FollowPath {
  bool follows = true;
};
/// The simulated sensor looks elsewhere, as if it had been taken out of the mouth, or comes back.
struct TakeSensorAway {
  bool is_away = true;
};
struct ChangeSettings {
  Settings settings;
};
/// Looks at the devices anew, and starts those that could not be started before.
struct CheckDevices {};
/// Scanning pauses, and the sensor is handed to the task.
struct BeginCalibration {
  CalibrationTask task = CalibrationTask::kCalibrate;
  std::string folder;               ///< of a calibration: where it is kept, or goes on
  double sphere_diameter_mm = 0.0;  ///< of a check on a sphere, > 0
};
/// Takes the images of the place that is wanted.
struct TakeCalibrationImages {};
/// A place is wanted again.
struct RetakeCalibrationPlace {
  std::size_t index = 0;  ///< in RunningCalibration::places
};
/// Scans are made with the new calibration from now on.
struct UseCalibration {};
/// Ends the task, done or not, and gives the sensor back. What is on disk stays there.
struct EndCalibration {};
/// Words that came over the control channel for the program itself, such as a test's "lose source".
struct Tell {
  std::string words;
};
struct Quit {};

using Command =
    std::variant<StartScan, PauseScan, Undo, Redo, EditSurface, AddMeasurement, RemoveMeasurement,
                 Finish, CancelFinish, ResumeScan, ChooseReentry, SelectStage, Export, NewCase,
                 OpenCase, SetCaseFields, SteerHand, FollowPath, TakeSensorAway, PointHand,
                 ChangeSettings, CheckDevices, BeginCalibration, TakeCalibrationImages,
                 RetakeCalibrationPlace, UseCalibration, EndCalibration, Tell, Quit>;

/// The name of a command for logs and tests: "StartScan".
[[nodiscard]] std::string_view name_of(const Command& command);

}  // namespace flytri::ui
