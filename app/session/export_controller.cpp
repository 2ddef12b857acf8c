#include "app/session/export_controller.h"

#include <utility>

#include "app/session/export_files.h"
#include "app/session/user_folders.h"

namespace flytri::session {

ExportController::ExportController(BackgroundWork& background, Notices& notices)
    : background_(background), notices_(notices) {
  state_.folder = documents_folder().string();
  state_.name = "jaw";
}

void ExportController::export_scan(const ui::Export& command,
                                   std::shared_ptr<const scan::ScanSnapshot> shown) {
  if (state_.is_running) return;
  state_.is_running = true;
  state_.failure.clear();
  background_.run([this, command, shown = std::move(shown)] {
    auto done = std::make_shared<Result<std::vector<ui::ExportedFile>>>(export_files(
        *shown, std::filesystem::path(command.folder) / command.name, command.formats));
    return [this, done] {
      state_.is_running = false;
      if (*done) {
        state_.written = **done;
        notices_.add(ui::Severity::kInformation, "Exported to " + state_.written.front().path);
      } else {
        state_.failure = done->error().message;
        notices_.add(ui::Severity::kError, state_.failure);
      }
    };
  });
}

ui::ExportState ExportController::state(const scan::ScanSnapshot* shown) const {
  ui::ExportState state = state_;
  if (shown != nullptr) state.estimated_bytes = estimated_bytes(*shown);
  return state;
}

}  // namespace flytri::session
