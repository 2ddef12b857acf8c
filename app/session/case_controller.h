/// @file  Controls the case of a session: creates, opens and describes it.
#pragma once

#include <filesystem>
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
  /// @param unnamed_folder  of scans that have no case yet
  CaseController(std::filesystem::path unnamed_folder, const SourceController& source,
                 StageController& stages, BackgroundWork& background, Notices& notices);

  /// Saves the scans in an unnamed case, unless a case is open: so nothing that was scanned is lost
  /// when the program ends.
  void save_unnamed();
  /// Creates a case. The unnamed case, if one is open, becomes this one. If a named case is open,
  /// that one keeps its scans, and the new case begins empty. On failure nothing changes.
  void create(const ui::NewCase& command);
  void open(const ui::OpenCase& command);
  /// Deletes an unnamed case. Does nothing to other files.
  void discard(const ui::DiscardCase& command);
  /// Before the end: removes the unnamed case if nothing was scanned.
  void close();
  /// Writes it in the background, then opens it.
  void save_rescue_copy(const ui::SaveRescueCopy& command);
  void set_fields(const ui::SetCaseFields& command);
  /// Warns if the case was scanned with another calibration than the source's.
  void warn_of_other_calibration();

  /// What the window shows of it. Reports what could not be saved.
  [[nodiscard]] ui::CaseState state();

 private:
  [[nodiscard]] CaseStore* store() const { return stages_.store().get(); }
  bool refuses_while_finishing();
  [[nodiscard]] bool is_unnamed() const;
  void name_unnamed(const ui::NewCase& command);
  /// Turns to another case; null: to none.
  void replace_by(std::shared_ptr<CaseStore> store);
  void accept_opened(bool is_encrypted);
  void list_cases();
  void report_failure();
  /// Once damage is found: looks what of the case can be read.
  void look_at_damage();

  const std::filesystem::path unnamed_folder_;
  const SourceController& source_;
  StageController& stages_;
  BackgroundWork& background_;
  Notices& notices_;
  ui::CaseState state_;  ///< all that the store itself does not say
  std::string reported_failure_;
  std::shared_ptr<CaseStore> looked_at_;  ///< whose damage is in the state
};

}  // namespace flytri::session
