/// @file  What stands behind the window: carries out its commands and says what it shows.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "app/session/background_work.h"
#include "app/session/calibration_controller.h"
#include "app/session/case_controller.h"
#include "app/session/export_controller.h"
#include "app/session/light_need.h"
#include "app/session/notices.h"
#include "app/session/occlusion_controller.h"
#include "app/session/path_chooser.h"
#include "app/session/plane_controller.h"
#include "app/session/review_controller.h"
#include "app/session/setup_controller.h"
#include "app/session/source_controller.h"
#include "app/session/stage_controller.h"
#include "app/session/user_folders.h"
#include "core/scan/live_scan.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

struct SessionOptions {
  SourceChoice source;
  scan::LiveScanOptions scan;  ///< the session sets now_s and journal
  /// Of the desktop: used unless the settings name another one.
  ui::Language language = ui::Language::kEnglish;
  /// Of scans that have no case yet.
  std::filesystem::path unnamed_folder = unnamed_cases_folder();
  /// Folder to record the raw frames in, from the start; empty: none.
  std::filesystem::path recording;
  /// Null: the desktop's portal.
  std::shared_ptr<desktop::FileChooser> file_chooser;
  /// The devices that a setup finds.
  std::function<setup::SetupMachine()> machine = setup::this_machine;
};

/// Connects the controllers. Used by the window's thread only; long work runs in the background.
class Session {
 public:
  explicit Session(SessionOptions options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void carry_out(const ui::Command& command);
  /// Call it once a frame of the window: the lights depend on it.
  void watch_window(const WindowUse& use) { window_use_ = use; }
  /// What the window shows now. Settles the background work that is done.
  [[nodiscard]] ui::AppView view();
  [[nodiscard]] bool is_closing() const { return is_closing_; }
  /// Monotonic; the clock of the session and of its scans.
  [[nodiscard]] double now_s() const;
  /// Of the current stage; null until the source is open.
  [[nodiscard]] std::shared_ptr<scan::LiveScan> scan() const { return stages_.scan(); }
  [[nodiscard]] const Source& source() const { return source_.source(); }

 private:
  void start(bool is_new);
  void pause();
  void finish();
  void finish_ahead();
  /// Of the present sensor, as meshing::MeshOptions.
  [[nodiscard]] double close_holes_mm() const;
  void export_scan(const ui::Export& command);
  void change_settings(const ui::Settings& settings);
  void use_set_up_sensor();
  void use_virtual_sensor();
  /// The next start scans with this sensor. @param file  empty: the virtual sensor
  void keep_rig(const std::string& file);

  bool is_closing_ = false;
  WindowUse window_use_;
  const ui::Language desktop_language_;
  ui::Settings settings_;
  ui::Texts texts_;
  Notices notices_;
  BackgroundWork background_;
  // Each knows those above it.
  SourceController source_;
  StageController stages_;
  CaseController case_;
  CalibrationController calibration_;
  SetupController setup_;
  ExportController exports_;
  OcclusionController occlusion_;
  PlaneController plane_;
  ReviewController review_;
  PathChooser chooser_;
};

}  // namespace flytri::session
