/// @file  State of the window only: camera, colors, tool, open dialog, typed text.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/scene/orbit_camera.h"
#include "ui/scene/scene_options.h"
#include "ui/state/app_view.h"
#include "ui/state/case_form.h"
#include "ui/state/question.h"
#include "ui/state/result_number.h"

namespace flytri::ui {

/// The tool that the pointer uses on the surface.
enum class Tool { kNone, kTrim, kLock, kUnlock, kMeasure, kPlane };

[[nodiscard]] std::string_view to_string(Tool tool);
[[nodiscard]] constexpr bool has_brush(Tool tool) {
  return tool == Tool::kTrim || tool == Tool::kLock || tool == Tool::kUnlock;
}
/// The edit that a tool with a brush makes.
[[nodiscard]] constexpr editing::EditKind kind_of(Tool tool) {
  if (tool == Tool::kLock) return editing::EditKind::kLock;
  return tool == Tool::kUnlock ? editing::EditKind::kUnlock : editing::EditKind::kTrim;
}

enum class Dialog {
  kNone,
  kHelp,
  kExport,
  kCase,
  kSettings,
  kDevices,
  kCalibration,
  kSetup,
  kQuestion,
  kStages
};
[[nodiscard]] std::string_view to_string(Dialog dialog);
[[nodiscard]] std::string_view to_string(ColorMode mode);

/// The camera, and what it was last moved for.
struct CameraState {
  OrbitCamera camera;
  PictureSize picture;           ///< of the latest frame
  std::optional<Vec3> pivot_mm;  ///< where the pointer took hold of the model; none: beside it
  bool follows_scan = true;      ///< shows the whole growing model, until the user moves the camera
  Eigen::AlignedBox3d followed_box_mm;  ///< the box shown last
  scan::ScanPhase seen_phase = scan::ScanPhase::kPreview;
  std::optional<std::size_t> seen_reentry;  ///< the place shown last
  bool has_seen_way_back = false;           ///< where a lost sensor is was known
  io::ScanStage seen_stage = io::ScanStage::kUpper;
  bool has_seen_model = false;
};

/// The brush and the current stroke.
struct BrushState {
  double radius_share = 0.1;  ///< of the volume's width, 0.01..0.5
  std::vector<editing::BrushDab> stroke;
  std::optional<editing::BrushDab> under_pointer;
};

/// How both closed jaws are shown.
struct JawsLook {
  bool are_shown = false;  ///< in place of the bite scan
  bool shows_clearance = true;
  double opening = 0.0;      ///< 0 closed..1 wide open
  double contact_mm = 0.02;  ///< nearer than this is contact
};

/// What is measured on a finished model.
enum class ReviewMode { kDistance, kAngle, kSection, kUndercut, kMargin };
[[nodiscard]] std::string_view to_string(ReviewMode mode);

/// What the user asked of the finished model, while the tool for measuring is in hand.
struct ReviewForm {
  ReviewMode mode = ReviewMode::kDistance;
  std::vector<Vec3> angle_mm;   ///< clicked so far: at most two
  std::vector<Vec3> margin_mm;  ///< clicked so far, in order along the edge
  std::optional<review::Plane> plane;
  std::vector<Vec3> section_mm;    ///< clicked in the picture of the section: at most two
  double section_width_mm = 16.0;  ///< 2..100, of that picture
  std::optional<Vec3> around_mm;   ///< a place on the prepared tooth
  double radius_mm = 7.0;          ///< 2..15, how much around it is looked at
  bool shows_undercut = true;      ///< the model has the colors of the undercut
  ResultNumber model;              ///< that all of this is about
  std::uint64_t model_number = 0;
};

struct ExportForm {
  std::string folder;
  std::string name;
  bool is_folder_edited = false;  ///< else the folder is the proposed one
  bool all_jaws = false;          ///< as far as that is possible, see exports_all_jaws()
  std::string proposed_name;  ///< the latest; a new one, of another case or stage, replaces `name`
};

struct CalibrationForm {
  std::string folder;
  bool is_edited = false;  ///< false: the folder is the proposed one
  std::string sphere_diameter_mm = "10";
  std::string note;
};

struct RecordingForm {
  std::string folder;
  bool is_edited = false;  ///< false: the folder is the proposed one
};

/// A typed length; none if the text is not a positive number.
[[nodiscard]] std::optional<double> typed_length_mm(const std::string& text);

/// The hole that the user selected.
struct SelectedHole {
  std::size_t index = 0;  ///< among the holes of the scan
  Vec3f center_mm = Vec3f::Zero();
  double width_mm = 0.0;
};

/// The selected hole in a newer list of holes; none if it was closed.
[[nodiscard]] std::optional<SelectedHole> found_again(const SelectedHole& selected,
                                                      std::span<const meshing::BoundaryLoop> holes);

/// A stage is being copied, and `next` is shown afterwards: there the tool to trim is taken in
/// hand, unless the user does something else meanwhile.
struct CopyOnItsWay {
  io::ScanStage from = io::ScanStage::kUpper, next = io::ScanStage::kUpper;
};

/// A notice on the screen.
struct ShownNotice {
  Notice notice;
  double since_s = 0.0;
};

struct WindowState {
  CameraState view;
  ColorMode color_mode = ColorMode::kShading;
  double texture_blend = 1.0;  ///< 0..1
  Tool tool = Tool::kNone;
  std::optional<CopyOnItsWay> copy;
  BrushState brush;
  JawsLook jaws;
  ReviewForm review;
  std::optional<Vec3> measured_from_mm;  ///< first of the two points
  std::vector<Vec3> plane_points_mm;     ///< those clicked of three, for the occlusal plane
  std::optional<SelectedHole> selected_hole;
  Dialog dialog = Dialog::kNone;
  ExportForm export_form;
  CaseForm case_form;
  CalibrationForm calibration_form;
  RecordingForm recording_form;
  Question question;
  std::vector<ShownNotice> toasts;
  std::uint64_t latest_notice = 0;
  std::uint64_t latest_choice = 0;  ///< of the file chooser, see take_chosen_path()
  ResultNumber result_number;       ///< of the result that is shown
  ResultNumber undercut_number;     ///< of the undercut that is shown
  double frame_s = 0.0;             ///< between the latest two frames
};

/// Forgets an unfinished stroke, distance or plane with it.
void put_tool_away(WindowState& state);

}  // namespace flytri::ui
