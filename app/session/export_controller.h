/// @file  Controls the export of what the window shows.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/session/background_work.h"
#include "app/session/case_store.h"
#include "app/session/export_jaws.h"
#include "app/session/lighter_models.h"
#include "app/session/notices.h"
#include "app/session/open_folder.h"
#include "core/scan/scan_snapshot.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

class ExportController {
 public:
  ExportController(BackgroundWork& background, Notices& notices);

  /// The case of what is exported.
  struct ExportCase {
    std::shared_ptr<CaseStore> store;  ///< its journal gets an entry; null: there is none
    /// Waits, on any thread, until all that was scanned has reached the case.
    std::function<void()> wait_until_kept;
  };
  /// Writes the files in the background. Does nothing while an export is running.
  /// @param margins  of the finished model
  void export_scan(const ui::Export& command, std::shared_ptr<const scan::ScanSnapshot> shown,
                   std::vector<io::StoredMargin> margins, ExportCase of, io::ScanStage stage);
  /// As export_scan, for all finished stages of a case.
  /// @param jaws  not empty
  /// @param of    with a store
  void export_jaws(const ui::Export& command, std::vector<JawToExport> jaws, ExportCase of);
  /// Makes the lighter meshes of a finished model in the background, one with each call: state()
  /// tells their sizes, and an export uses them. Does nothing while one is made, or an export runs.
  /// @param result  null: does nothing
  void prepare(const std::shared_ptr<const reconstruct::FinishedScan>& result);
  /// Shows the folder of the latest export in the file manager.
  void open_folder();
  /// @param view  with the scan, the stage and the case: what can be exported, and under which name
  [[nodiscard]] ui::ExportState state(const ui::AppView& view);

 private:
  using Model = std::shared_ptr<const reconstruct::FinishedScan>;
  void forget_outcome();
  /// Forgets the outcome of the export before.
  void begin(const ui::Export& command);
  /// @param exported  the models of which files were written
  void end(const Result<ExportOutcome>& done, const std::vector<Model>& exported);
  /// @param result  not null
  std::shared_ptr<LighterModels> lighter_of(
      const std::shared_ptr<const reconstruct::FinishedScan>& result);
  void propose_name(const ui::CaseState& file, io::ScanStage stage);
  void tell_sizes(const ui::AppView& view, ui::ExportState& state);

  BackgroundWork& background_;
  Notices& notices_;
  FolderOpener opener_;
  ui::ExportState state_;
  std::string named_after_;  ///< what the proposed name is made of
  std::vector<std::weak_ptr<const reconstruct::FinishedScan>> exported_;  ///< by the latest export
  std::shared_ptr<LighterModels> lighter_;  ///< of the latest model; null: none
  bool is_preparing_ = false;
  std::string subject_;  ///< path of the case, and stage, that the latest export is of
};

}  // namespace flytri::session
