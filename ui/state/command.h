/// @file  Commands of the user: the window returns them, the program carries them out.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/secret.h"
#include "core/editing/edits.h"
#include "ui/state/app_view.h"

namespace flytri::ui {

/// Starts scanning, or resumes it after a pause.
struct StartScan {};
struct PauseScan {};
struct Undo {};
struct Redo {};
/// One stroke of the brush. The program sets its time.
struct EditSurface {
  editing::EditKind kind = editing::EditKind::kTrim;
  std::vector<editing::BrushDab> dabs;  ///< at least 1, world frame
};
/// Shows or hides what was in the way for a time, such as a tongue.
struct ShowCrossed {
  bool are_shown = true;
};
/// Empties a stage, so that it can be scanned again. The case keeps what was in it.
struct ClearStage {
  io::ScanStage stage = io::ScanStage::kUpper;
};
/// Shows the scan of the current stage that was cleared, and keeps the one that is shown.
struct BringBackStage {};
/// Starts an empty stage of the same jaw as a copy of the current one.
struct CopyStage {
  io::ScanStage to = io::ScanStage::kUpperPreop;
};
struct AddMeasurement {
  io::Measurement measurement;
};
struct RemoveMeasurement {
  std::size_t index = 0;  ///< in AppView::measurements
};
/// Finds the occlusal plane of the finished jaw that is shown.
struct FindOcclusalPlane {};
/// Sets it. It stays as it is if the points cannot be those of an occlusal plane.
struct SetOcclusalPlane {
  std::optional<OcclusalPoints> points;  ///< none: the program finds the plane
};
/// Makes the finished model ready to be measured on.
struct BeginReview {};
/// Measures the angle at the second of three points.
struct MeasureAngle {
  std::array<Vec3, 3> points_mm;
};
struct RemoveAngle {
  std::size_t index = 0;  ///< in ReviewState::angles_rad
};
/// Cuts the finished model.
struct CutSection {
  review::Plane plane;
  std::vector<Vec3> points_mm;  ///< none, or two near the section: measures between them
};
/// Finds what of the finished model is undercut.
struct FindUndercut {
  review::UndercutRequest request;
};
/// Finds the margin line along these clicks. Fewer than three: there is none.
struct DrawMargin {
  std::vector<Vec3> clicks_mm;
};
/// Keeps the drawn margin line in the case.
struct KeepMargin {};
struct RemoveMargin {
  std::size_t index = 0;  ///< in ReviewState::margins
};
struct Finish {};
struct CancelFinish {};
/// Discards the result and resumes scanning.
struct ResumeScan {};
struct ChooseReentry {
  std::size_t index = 0;  ///< in ScanSnapshot::reentry
};
struct SelectStage {
  io::ScanStage stage = io::ScanStage::kUpper;
};
/// Writes the shown model, or all jaws. Nothing is written if a file exists that may not be
/// replaced: ExportState::existing lists such files.
struct Export {
  ExportTarget target;                ///< at least 1 format, or a report
  std::vector<std::string> replaced;  ///< paths of files that may be replaced
};
/// Makes the lighter meshes of the finished model, so that their sizes can be shown.
struct PrepareExport {};
/// Shows the folder of the latest export in the desktop's file manager.
struct OpenExportFolder {};
struct NewCase {
  std::string path;
  Secret passphrase;  ///< empty: not encrypted
  io::CaseFields fields;
};
struct OpenCase {
  std::string path;
  Secret passphrase;
};
/// Deletes an unnamed case.
struct DiscardCase {
  std::string path;
};
/// Copies what can be read of the damaged case to a new file, and opens that.
struct SaveRescueCopy {
  std::string path;
};
struct SetCaseFields {
  io::CaseFields fields;
};
/// Moves the simulated sensor, in its own frame: x right and y down in the live image, z towards
/// the teeth.
struct SteerHand {
  Vec3 move_mm = Vec3::Zero();
  Vec3 turn_rad = Vec3::Zero();  ///< rotation vector
};
/// Moves the simulated sensor to where a ray hits the object, world frame. Does nothing if the ray
/// misses.
struct PointHand {
  Vec3 origin_mm = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();  ///< unit
};
/// The simulated sensor follows its path, or the pointer.
struct FollowPath {
  bool follows = true;
};
/// Lifts the simulated sensor off the teeth, or returns it.
struct TakeSensorAway {
  bool is_away = true;  ///< false: returns it
};
struct ChangeSettings {
  Settings settings;
};
/// Begins or ends the recording of the sensor's raw frames.
struct RecordFrames {
  bool is_on = true;
  std::string folder;  ///< in which the recording gets a folder of its own
};
/// Opens the desktop's file chooser.
struct ChoosePath {
  PathField field = PathField::kCase;
  std::string now;  ///< the path in the field
};
/// Checks the devices, and starts those that failed to start.
struct CheckDevices {};
/// Pauses scanning, and uses the sensor for the task.
struct BeginCalibration {
  CalibrationTask task = CalibrationTask::kCalibrate;
  std::string folder;               ///< of a new calibration, or of one to continue
  double sphere_diameter_mm = 0.0;  ///< of a check on a sphere, > 0
  std::string note;                 ///< kept with the calibration or the check
};
/// Takes the images at the next place.
struct TakeCalibrationImages {};
/// Makes a finished place the next one again.
struct RetakeCalibrationPlace {
  std::size_t index = 0;  ///< in RunningCalibration::places
};
/// Uses the new calibration for scanning.
struct UseCalibration {};
/// Ends the task and frees the sensor. Images on disk are kept.
struct EndCalibration {};
/// Pauses scanning, and finds out which cameras and lights there are.
struct BeginSetup {};
struct AnswerSetup {
  int question = 0;       ///< SetupQuestion::number
  std::size_t index = 0;  ///< in SetupQuestion::answers
};
/// Scans with the sensor that was set up, also after the next start.
struct UseSetup {};
struct UseVirtualSensor {};
/// Ends the setup and frees the devices.
struct EndSetup {};
/// A message from the control channel to the program, such as "lose source" of a test.
struct Tell {
  std::string words;
};
struct Quit {};

using Command = std::variant<
    StartScan, PauseScan, Undo, Redo, EditSurface, ShowCrossed, ClearStage, BringBackStage,
    CopyStage, AddMeasurement, RemoveMeasurement, FindOcclusalPlane, SetOcclusalPlane, BeginReview,
    MeasureAngle, RemoveAngle, CutSection, FindUndercut, DrawMargin, KeepMargin, RemoveMargin,
    Finish, CancelFinish, ResumeScan, ChooseReentry, SelectStage, Export, PrepareExport,
    OpenExportFolder, NewCase, OpenCase, DiscardCase, SaveRescueCopy, SetCaseFields, SteerHand,
    FollowPath, TakeSensorAway, PointHand, ChangeSettings, RecordFrames, ChoosePath, CheckDevices,
    BeginCalibration, TakeCalibrationImages, RetakeCalibrationPlace, UseCalibration, EndCalibration,
    BeginSetup, AnswerSetup, UseSetup, UseVirtualSensor, EndSetup, Tell, Quit>;

/// The name of a command for logs and tests: "StartScan".
[[nodiscard]] std::string_view name_of(const Command& command);

}  // namespace flytri::ui
