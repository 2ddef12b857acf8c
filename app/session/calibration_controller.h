/// @file  Controls the calibration of a session's sensor: starts a calibration or a check, and
/// takes a new calibration into use.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/session/background_work.h"
#include "app/session/calibration_run.h"
#include "app/session/notices.h"
#include "app/session/stage_controller.h"
#include "ui/state/calibration_state.h"
#include "ui/state/command.h"

namespace flytri::session {

class CalibrationController {
 public:
  CalibrationController(SourceController& source, StageController& stages,
                        BackgroundWork& background, Notices& notices);

  /// Pauses the scan and lends the devices to a calibration or a check.
  void begin(const ui::BeginCalibration& command);
  void take_images();
  void retake(std::size_t place);
  /// Ends the calibration and measures with its result from now on.
  void use();
  /// Call it once a frame of the window. Notes a check that has ended: in the file of the
  /// calibration, with the open case, and for the cases to come.
  void note_finished_check();
  /// Ends the calibration or check, and captures frames again.
  void end();
  /// Ends everything at once, as the session does when it ends.
  void stop() { run_.reset(); }

  /// None for a recording: its sensor is not here.
  [[nodiscard]] std::optional<ui::CalibrationState> state() const;

 private:
  /// Ends the run in the background, then calls `then`: the devices are free.
  void close(std::function<void()> then);
  /// Why a new calibration cannot be taken into use now. Empty: it can.
  [[nodiscard]] std::string why_not_used() const;

  SourceController& source_;
  StageController& stages_;
  BackgroundWork& background_;
  Notices& notices_;
  std::filesystem::path proposed_folder_;  ///< for the next calibration
  std::shared_ptr<CalibrationRun> run_;    ///< null: none is running
  std::shared_ptr<const calibration::Calibration>
      checked_;       ///< by the run; null: no check, or noted
  std::string note_;  ///< of the run
  bool is_closing_ = false;
};

}  // namespace flytri::session
