/// @file  Controls the setup of a sensor, and which sensor the program scans with from then on.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/session/background_work.h"
#include "app/session/notices.h"
#include "app/session/setup_run.h"
#include "app/session/stage_controller.h"
#include "hw/setup/setup_machine.h"
#include "ui/state/command.h"

namespace flytri::session {

class SetupController {
 public:
  /// @param machine  called for each setup
  SetupController(std::function<setup::SetupMachine()> machine, SourceController& source,
                  StageController& stages, BackgroundWork& background, Notices& notices);

  /// Pauses the scan and lends the devices to a setup.
  void begin();
  void answer(const ui::AnswerSetup& given);
  /// Ends the setup and scans with its sensor from now on.
  /// @return  its rig.json; none: it cannot be used now
  std::optional<std::filesystem::path> use();
  /// Scans with the virtual sensor from now on. @return  false: it cannot be used now
  bool use_virtual_sensor();
  /// Ends the setup, and captures frames again.
  void end();
  /// Ends everything at once, as the session does when it ends.
  void stop() { run_.reset(); }

  [[nodiscard]] ui::SetupState state() const;

 private:
  /// Ends the run in the background, then calls `then`: the devices are free.
  void close(std::function<void()> then);
  void change_source(SourceChoice choice);
  [[nodiscard]] std::string why_not_used() const;

  const std::function<setup::SetupMachine()> machine_;
  SourceController& source_;
  StageController& stages_;
  BackgroundWork& background_;
  Notices& notices_;
  std::shared_ptr<SetupRun> run_;  ///< null: none is running
  bool is_closing_ = false;
};

}  // namespace flytri::session
