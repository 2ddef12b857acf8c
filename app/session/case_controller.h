/// @file  Controls the case of a session: creates, opens and describes it.
#pragma once

#include <memory>
#include <string>

#include "app/session/background_work.h"
#include "app/session/notices.h"
#include "app/session/stage_controller.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

class CaseController {
 public:
  CaseController(const SourceController& source, StageController& stages,
                 BackgroundWork& background, Notices& notices);

  /// Creates a case. What was scanned without a case is saved in it. If another case is open, that
  /// one keeps its scans, and the new case begins empty. On failure nothing changes.
  void create(const ui::NewCase& command);
  void open(const ui::OpenCase& command);
  void set_fields(const ui::SetCaseFields& command);
  /// Warns if the case was scanned with another calibration than the source's.
  void warn_of_other_calibration();

  /// What the window shows of it. Reports what could not be saved.
  [[nodiscard]] ui::CaseState state();

 private:
  [[nodiscard]] CaseStore* store() const { return stages_.store().get(); }
  bool refuses_while_finishing();
  void accept_opened(const std::string& passphrase);
  void list_cases();
  void report_failure();

  const SourceController& source_;
  StageController& stages_;
  BackgroundWork& background_;
  Notices& notices_;
  ui::CaseState state_;  ///< all that the store itself does not say
  std::string reported_failure_;
};

}  // namespace flytri::session
