/// @file  Controls the export of what the window shows.
#pragma once

#include "app/session/background_work.h"
#include "app/session/notices.h"
#include "core/scan/scan_snapshot.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

class ExportController {
 public:
  ExportController(BackgroundWork& background, Notices& notices);

  /// Writes the files in the background. Does nothing while an export is running.
  void export_scan(const ui::Export& command, std::shared_ptr<const scan::ScanSnapshot> shown);
  /// @param shown  null: nothing can be exported yet
  [[nodiscard]] ui::ExportState state(const scan::ScanSnapshot* shown) const;

 private:
  BackgroundWork& background_;
  Notices& notices_;
  ui::ExportState state_;
};

}  // namespace flytri::session
