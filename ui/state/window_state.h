/// @file  What the window alone knows: camera, colors, tool, open dialog, half-typed text.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/models/model_formats.h"
#include "ui/scene/orbit_camera.h"
#include "ui/scene/scene_options.h"
#include "ui/state/app_view.h"

namespace flytri::ui {

/// What the pointer does on the surface.
enum class Tool { kNone, kTrim, kLock, kUnlock, kMeasure };

[[nodiscard]] std::string_view to_string(Tool tool);
[[nodiscard]] constexpr bool has_brush(Tool tool) {
  return tool == Tool::kTrim || tool == Tool::kLock || tool == Tool::kUnlock;
}
/// What a tool with a brush does to the surface.
[[nodiscard]] constexpr editing::EditKind kind_of(Tool tool) {
  if (tool == Tool::kLock) return editing::EditKind::kLock;
  return tool == Tool::kUnlock ? editing::EditKind::kUnlock : editing::EditKind::kTrim;
}

enum class Dialog { kNone, kHelp, kExport, kCase, kSettings, kDevices, kCalibration };
[[nodiscard]] std::string_view to_string(Dialog dialog);
[[nodiscard]] std::string_view to_string(ColorMode mode);

/// The camera's own business.
struct CameraState {
  OrbitCamera camera;
  PictureSize picture;       ///< of the latest frame
  bool follows_scan = true;  ///< shows all of the model as it grows, until the user takes over
  Eigen::AlignedBox3d followed_box_mm;  ///< what the camera was last sent to show
  scan::ScanPhase seen_phase = scan::ScanPhase::kPreview;
  std::optional<std::size_t> seen_reentry;  ///< the place that the camera was last sent to
  io::ScanStage seen_stage = io::ScanStage::kUpper;
  bool has_seen_model = false;
};

/// The brush and the stroke that is being drawn.
struct BrushState {
  double radius_share = 0.1;  ///< of the volume's width, 0.01..0.5
  std::vector<editing::BrushDab> stroke;
  std::optional<editing::BrushDab> under_pointer;
};

struct ExportForm {
  std::string folder;
  std::string name;
  /// Extensions, as in io::model_formats().
  std::set<std::string_view> formats = {io::model_formats().front().extension};
  bool is_edited = false;  ///< else folder and name are those proposed
};

enum class CaseTab { kFields, kNew, kOpen };

struct CaseForm {
  CaseTab tab = CaseTab::kNew;  ///< kFields only while a case is open
  io::CaseFields fields;
  std::string path;
  std::string passphrase;
  bool is_asked = false;        ///< the program was asked; the dialog closes when the case is open
  bool is_path_edited = false;  ///< else the path of a new case is proposed from its fields
};

struct CalibrationForm {
  std::string folder;
  bool is_edited = false;  ///< else the folder is the one proposed
  std::string sphere_diameter_mm = "10";
};

/// What was typed as a length; none where it is no length.
[[nodiscard]] std::optional<double> typed_length_mm(const std::string& text);

/// The hole that the user went to.
struct SelectedHole {
  std::size_t index = 0;  ///< among the holes of the scan
  Vec3f center_mm = Vec3f::Zero();
  double width_mm = 0.0;
};

/// Where the selected hole is among the holes that were found since; none where it was closed.
[[nodiscard]] std::optional<SelectedHole> found_again(const SelectedHole& selected,
                                                      std::span<const meshing::BoundaryLoop> holes);

/// A notice while it shows.
struct ShownNotice {
  Notice notice;
  double since_s = 0.0;
};

struct WindowState {
  CameraState view;
  ColorMode color_mode = ColorMode::kShading;
  double texture_blend = 1.0;  ///< 0..1
  Tool tool = Tool::kNone;
  BrushState brush;
  std::optional<Vec3> measured_from_mm;  ///< first of the two points
  std::optional<SelectedHole> selected_hole;
  Dialog dialog = Dialog::kNone;
  ExportForm export_form;
  CaseForm case_form;
  CalibrationForm calibration_form;
  std::vector<ShownNotice> toasts;
  std::uint64_t latest_notice = 0;
  double frame_s = 0.0;  ///< between the latest two frames
};

}  // namespace flytri::ui
