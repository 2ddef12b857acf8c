/// @file  Everything that the window shows at one moment. The program makes one for every frame.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/jaw_axes.h"
#include "core/geometry/triangle_mesh.h"
#include "core/io/cases/case_file.h"
#include "core/reconstruct/mesh_density.h"
#include "core/scan/scan_snapshot.h"
#include "ui/state/calibration_state.h"
#include "ui/state/devices_state.h"
#include "ui/state/review_state.h"
#include "ui/state/setup_state.h"
#include "ui/text/texts.h"

namespace flytri::ui {

/// A case that can be opened, as the list at the start shows it.
struct KnownCase {
  std::string path;
  std::string patient;   ///< empty if the case is encrypted or has none
  std::string modified;  ///< date and time, as shown
  bool is_encrypted = false;
  std::string number = {};  ///< the patient's or the case's
  bool is_unnamed = false;  ///< a scan that was never saved in a case
};

/// The open case is damaged: what of it could be read, and a copy of that.
struct DamagedCase {
  std::optional<io::CaseSurvey> survey;  ///< none: it is still being read
  std::string copy_path;                 ///< proposed; there is no such file
  bool is_copying = false;
};

/// The case that is open. A scan without a case is saved in an unnamed one.
struct CaseState {
  std::string path;  ///< empty: no case is open yet
  bool is_unnamed = false;
  io::CaseFields fields;
  bool is_saved = true;     ///< the whole scan is on disk, except for the last second
  std::string failure;      ///< why the scan is not saved, and what to do; empty: it is
  bool is_opening = false;  ///< another case is being opened
  bool is_moving = false;   ///< the unnamed case is becoming a named one
  bool is_encrypted = false;
  bool is_read_only = false;  ///< damaged, or open in another program; `message` says which
  std::string message;        ///< why the case could not be opened, or what could be read of it
  bool passphrase_is_asked = false;  ///< the case at `path_asked` needs one
  std::string path_asked;
  std::optional<DamagedCase> damaged;  ///< none: no damage was found
  std::vector<KnownCase> known;        ///< newest first
  std::string folder;                  ///< of new cases
};

enum class SourceKind { kSimulated, kRecording, kDevices };

/// The simulated hand that moves the simulated sensor.
struct SimulatedHand {
  bool follows_path = true;  ///< false: pointer and arrow keys move it
  bool is_taken_away = false;
};

/// Where the frames come from.
struct SourceState {
  SourceKind kind = SourceKind::kSimulated;
  std::string name;              ///< of the rig, the recording or the simulated sensor
  bool is_running = false;       ///< frames are coming
  bool is_lost = false;          ///< a device is missing; `message` says which and what to do
  bool has_ended = false;        ///< a recording has been played to its end
  bool waits_for_focus = false;  ///< the lights are off until the window has the focus
  std::string message;
  std::optional<SimulatedHand> hand;   ///< of a simulated source
  std::optional<double> played_share;  ///< of a recording: 0..1
};

/// The recording of the sensor's raw frames, for whoever is to find out what went wrong.
struct RecordingState {
  std::string folder;        ///< in which each recording gets a folder of its own
  bool is_possible = false;  ///< the source is no recording itself
  bool is_on = false;
  std::string path;  ///< of the latest recording
  std::int64_t frames = 0;
  std::uint64_t bytes = 0;
  std::optional<std::uint64_t> free_bytes;  ///< of the disk; none: unknown
  std::string failure;                      ///< what is missing in it, or why it has ended
};

/// A field with a path that the desktop's file chooser can fill.
enum class PathField { kCase, kNewCase, kExportFolder, kCalibrationFolder, kRecordingFolder };

struct ChosenPath {
  std::uint64_t number = 0;  ///< rises from choice to choice
  PathField field = PathField::kCase;
  std::string path;
};

/// The desktop's file chooser.
struct ChooserState {
  std::string why_not;               ///< why there is none; empty: there is
  bool is_open = false;              ///< the user is choosing
  std::optional<ChosenPath> chosen;  ///< the latest
};

struct ExportedFile {
  std::string path;
  std::uint64_t bytes = 0;
};

/// Both closed jaws in one mesh: first the upper one, whose frame it is, then the lower one.
struct JawPair {
  TexturedMesh mesh;                ///< without texture; its vertices have colors
  std::uint32_t first_lower = 0;    ///< vertex
  std::vector<float> clearance_mm;  ///< by vertex; NaN: none within the limit
  JawAxes upper_axes;               ///< with a box around both
};

/// How the jaws meet.
struct OcclusionState {
  bool is_running = false;  ///< the jaws are being closed
  double done_share = 0.0;
  std::string failure;                  ///< why they could not be
  std::shared_ptr<const JawPair> pair;  ///< null: not known yet; the following is about it
  double middle_uncertainty_mm = 0.0, far_uncertainty_mm = 0.0;
  double far_mm = 0.0;  ///< from the middle of the bite to where the uncertainty is largest
  std::size_t bite_count = 1;
  bool bites_are_on_one_side = false;  ///< there are several, all of the same half of the arch
};

/// The occlusal plane of a finished jaw, and the axes of the patient.
struct OcclusalPlane {
  /// The plane is z = 0, see occlusion::T_patient_jaw.
  Isometry T_world_patient = Isometry::Identity();
  Eigen::AlignedBox3d box_mm;  ///< of the jaw, frame of the patient
  bool is_arch = false;        ///< else -y is the side of the cheek, and x is not known
};

/// What the user asks to export.
struct ExportTarget {
  std::string folder;  ///< as typed: may begin with ~
  std::string name;    ///< without extension
  /// Extensions, in the order of io::model_formats(). With a report there may be none.
  std::vector<std::string_view> formats;
  reconstruct::MeshDensity density = reconstruct::MeshDensity::kCad;  ///< of a finished model
  bool all_jaws = false;  ///< every finished stage of the case, in one frame
  bool report = false;    ///< of a finished model, or of each: a page about the scan beside it
  bool operator==(const ExportTarget&) const = default;
};

/// The finished model in one density.
struct DensityState {
  std::size_t triangles = 0;          ///< 0: not known yet
  double rms_mm = 0.0, max_mm = 0.0;  ///< from the full surface
};

/// What can be exported, and what was.
struct ExportState {
  std::string folder;     ///< proposed
  std::string name;       ///< proposed, without extension
  std::string jaws_name;  ///< proposed for all jaws; empty: at most one stage is finished
  /// About the size of each format's files, by extension. Formats that cannot hold what the window
  /// shows are missing.
  /// 0: not known before the model of this density is made.
  std::map<std::string_view, std::uint64_t> estimated_bytes;
  std::array<DensityState, reconstruct::kMeshDensities.size()> densities;  ///< as kMeshDensities
  bool is_running = false;
  bool has_model = false;  ///< the finished model that is shown was exported
  ExportTarget latest;     ///< of the latest export of this stage; the following is its outcome
  std::vector<ExportedFile> written;
  std::vector<std::string> existing;  ///< paths; nothing is written before the user allows to
                                      ///< replace these files
  std::string failure;
};

/// The user's settings, saved between runs.
struct Settings {
  std::string language;     ///< ISO 639-1; empty: the desktop's
  double user_scale = 1.0;  ///< 0.75..2, times the scale of the screen
  bool is_muted = false;
  bool is_dark_without_focus =
      false;  ///< the lights of a rig are off while the window has no focus
  bool is_full_screen = false;
  int window_width = 1280;       ///< >= 640; with window_height at scale 1, when not in full screen
  int window_height = 800;       ///< >= 400
  std::string recording_folder;  ///< empty: the proposed one
  std::string rig_file;          ///< of the sensor that was set up; empty: the virtual one
  std::set<std::string> export_formats = {".glb", ".stl", ".ply"};         ///< extensions
  bool export_report = false;                                              ///< beside the models
  reconstruct::MeshDensity mesh_density = reconstruct::MeshDensity::kCad;  ///< of exports
  /// 0..10, see meshing::MeshOptions; from the next Finish on. Of a sensor for teeth; others times
  /// calibration::line_distance_factor().
  double close_holes_mm = 0.0;
  bool operator==(const Settings&) const = default;
};

enum class Severity { kInformation, kWarning, kError };

/// A short message, shown for a few seconds.
struct Notice {
  std::uint64_t number = 0;  ///< rises from notice to notice
  Severity severity = Severity::kInformation;
  std::string text;
};

template <typename T>
using ByStage = std::array<T, io::kScanStages.size()>;

/// Immutable. Texts are UTF-8.
struct AppView {
  double now_s = 0.0;                              ///< monotonic; drives all animation
  std::shared_ptr<const scan::ScanSnapshot> scan;  ///< of the current stage; null: nothing yet
  bool is_scanning = false;                        ///< started and not paused
  bool is_loading = false;              ///< the current stage is being read from its case
  std::string load_failure;             ///< why it could not be read; empty: it was
  Vec3 volume_mm = {20.0, 15.0, 15.0};  ///< the sensor's measurement volume

  CaseState file;
  io::ScanStage stage = io::ScanStage::kUpper;
  ByStage<bool> stage_has_data = {};
  ByStage<bool> stage_is_finished = {};
  OcclusionState occlusion;
  bool has_kept_scan = false;  ///< the current stage was cleared, and its scan is kept
  SourceState source;
  ExportState exports;
  RecordingState recording;
  ChooserState chooser;
  std::vector<io::Measurement> measurements;  ///< of the current stage
  std::optional<OcclusalPlane> plane;  ///< of the current stage; none: not finished, or not known
  bool has_set_plane = false;          ///< the user has set the plane of the current stage
  ReviewState review;                  ///< of its finished model
  Settings settings;
  Texts texts;                          ///< in the language of the settings
  std::vector<Notice> notices;          ///< newest last
  std::optional<DevicesState> devices;  ///< of a rig; none: simulated or recorded
  std::optional<CalibrationState>
      calibration;  ///< none for a recording: its sensor is not connected
  SetupState setup;
};

}  // namespace flytri::ui
