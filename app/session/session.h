/// @file  Owns sensor, scans and case: carries out what the window asks for, and says what to show.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/session/calibration_desk.h"
#include "app/session/case_store.h"
#include "app/session/frame_router.h"
#include "app/session/source.h"
#include "core/base/task_thread.h"
#include "core/scan/live_scan.h"
#include "hw/device/capture_loop.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

struct SessionOptions {
  SourceChoice source;
  scan::LiveScanOptions scan;  ///< now_s and journal are the session's own
};

/// Used by the window's thread alone; what takes time is done beside it.
class Session {
 public:
  explicit Session(SessionOptions options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void carry_out(const ui::Command& command);
  /// What is to be shown now; settles what was done beside since the last call.
  [[nodiscard]] ui::AppView view();
  [[nodiscard]] bool is_closing() const { return is_closing_; }
  /// The clock of the session and of its scans, monotonic.
  [[nodiscard]] double now_s() const;
  /// Of the current stage; null until the source is open.
  [[nodiscard]] std::shared_ptr<scan::LiveScan> scan() const;
  [[nodiscard]] const Source& source() const { return source_; }

 private:
  // One function a command.
  void handle(const ui::StartScan&);
  void handle(const ui::PauseScan&);
  void handle(const ui::Undo&);
  void handle(const ui::Redo&);
  void handle(const ui::EditSurface& command);
  void handle(const ui::AddMeasurement& command);
  void handle(const ui::RemoveMeasurement& command);
  void handle(const ui::Finish&);
  void handle(const ui::CancelFinish&);
  void handle(const ui::ResumeScan&);
  void handle(const ui::ChooseReentry& command);
  void handle(const ui::SelectStage& command);
  void handle(const ui::Export& command);
  void handle(const ui::NewCase& command);
  void handle(const ui::OpenCase& command);
  void handle(const ui::SetCaseFields& command);
  void handle(const ui::SteerHand& command);
  void handle(const ui::FollowPath& command);
  void handle(const ui::TakeSensorAway& command);
  void handle(const ui::PointHand& command);
  void handle(const ui::ChangeSettings& command);
  void handle(const ui::CheckDevices&);
  void handle(const ui::BeginCalibration& command);
  void handle(const ui::TakeCalibrationImages&);
  void handle(const ui::RetakeCalibrationPlace& command);
  void handle(const ui::UseCalibration&);
  void handle(const ui::EndCalibration&);
  void handle(const ui::Tell& command);
  void handle(const ui::Quit&) { is_closing_ = true; }

  /// Work that takes time; what it returns is called by view().
  void do_in_background(std::function<std::function<void()>()> work);
  void open_chosen_source();
  void use_source(Source source);
  void start_capture();
  /// What could not be opened or started is tried again.
  void retry_source();
  /// Ends the calibration desk beside, and then, when the devices are free, goes on.
  void close_desk(std::function<void()> then);
  void show_stage();
  void use_stage(std::size_t stage, const OpenedStage& opened);
  void use_case(std::shared_ptr<CaseStore> store);
  void warn_of_other_calibration();
  void forget_scans();
  void list_cases();
  void notice(ui::Severity severity, std::string text);
  [[nodiscard]] ui::SourceState source_state() const;
  [[nodiscard]] std::optional<ui::DevicesState> devices_state(const ui::SourceState& source) const;
  [[nodiscard]] std::optional<ui::CalibrationState> calibration_state() const;
  /// Why scans cannot be made with a new calibration now; empty: they can.
  [[nodiscard]] std::string why_calibration_is_not_used() const;
  [[nodiscard]] ui::ExportState export_state(const scan::ScanSnapshot* shown) const;
  [[nodiscard]] ui::CaseState case_state() const;

  SessionOptions options_;
  bool is_closing_ = false;
  bool is_started_ = false;  ///< the user wants to scan
  Source source_;
  std::string source_failure_;
  ui::DevicesState devices_check_;            ///< of the latest check; devices are added by view()
  std::filesystem::path calibration_folder_;  ///< proposed for the next calibration
  /// While it is there the devices are its, and no frames are captured.
  std::shared_ptr<CalibrationDesk> desk_;
  bool is_desk_closing_ = false;
  std::shared_ptr<FrameRouter> router_ = std::make_shared<FrameRouter>();
  std::size_t stage_ = 0;
  std::array<std::shared_ptr<scan::LiveScan>, io::kScanStages.size()> scans_;
  std::array<std::vector<io::Measurement>, io::kScanStages.size()> measurements_;
  std::array<bool, io::kScanStages.size()> is_loading_ = {};
  std::shared_ptr<CaseStore> case_;  ///< null: nothing is kept
  ui::CaseState case_state_;         ///< all but what case_ itself says
  std::string noticed_case_failure_;
  ui::Settings settings_;
  ui::ExportState exports_;
  std::vector<ui::Notice> notices_;
  std::uint64_t notice_number_ = 0;
  std::string noticed_failure_;

  std::mutex done_mutex_;
  std::vector<std::function<void()>> done_;  ///< by view()
  Progress background_;                      ///< cancelled when the session ends
  TaskThread background_thread_;
  std::unique_ptr<device::CaptureLoop> capture_;  ///< ends first: it uses the router
};

}  // namespace flytri::session
