#include "app/session/case_controller.h"

#include <fmt/chrono.h>

#include <ctime>
#include <utility>
#include <vector>

#include "app/session/user_folders.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/files/file_bytes.h"

namespace flytri::session {
namespace {

std::filesystem::path cases_folder() { return data_folder() / "cases"; }

/// Creates the file with all that a case needs from the beginning.
Result<io::CaseFile> create_file(const ui::NewCase& command,
                                 const calibration::Calibration& calibration) {
  const std::filesystem::path path = command.path;
  if (auto made = io::create_folder(path.parent_path()); !made) return tl::unexpected(made.error());
  io::CaseFields fields = command.fields;
  fields.created = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  io::CaseOptions options;
  options.passphrase = command.passphrase;
  return io::CaseFile::create(path, options, fields, io::to_json(calibration));
}

}  // namespace

CaseController::CaseController(const SourceController& source, StageController& stages,
                               BackgroundWork& background, Notices& notices)
    : source_(source), stages_(stages), background_(background), notices_(notices) {
  state_.folder = cases_folder().string();
  list_cases();
}

bool CaseController::refuses_while_finishing() {
  if (stages_.may_leave()) return false;
  state_.message = "The scan is finishing. Wait until it is done, or cancel it (Escape).";
  return true;
}

void CaseController::create(const ui::NewCase& command) {
  if (refuses_while_finishing()) return;
  if (source_.calibration() == nullptr) {
    state_.message =
        "A case contains the calibration of its sensor. Wait until the sensor is ready.";
    return;
  }
  Result<io::CaseFile> file = create_file(command, *source_.calibration());
  if (!file) {
    state_.message = file.error().message;
    return;
  }
  auto store = std::make_shared<CaseStore>(std::move(*file));
  if (stages_.store() == nullptr) {
    stages_.save_in(store);
  } else {
    stages_.replace_by(std::move(store));
  }
  accept_opened(command.passphrase);
}

void CaseController::open(const ui::OpenCase& command) {
  if (refuses_while_finishing()) return;
  background_.run([this, command] {
    io::CaseOptions options;
    options.passphrase = command.passphrase;
    auto file = std::make_shared<Result<io::CaseFile>>(io::CaseFile::open(command.path, options));
    return [this, command, file] {
      if (!*file) {
        state_.message = file->error().message;
        state_.passphrase_is_asked = file->error().code == ErrorCode::kInconsistent;
        state_.path_asked = command.path;
        return;
      }
      if (refuses_while_finishing()) return;
      stages_.replace_by(std::make_shared<CaseStore>(std::move(**file)));
      accept_opened(command.passphrase);
      warn_of_other_calibration();
    };
  });
}

void CaseController::accept_opened(const std::string& passphrase) {
  state_.message.clear();
  state_.passphrase_is_asked = false;
  state_.is_encrypted = !passphrase.empty();
  state_.fields = store()->fields().value_or(io::CaseFields{});
  for (const std::string& line : store()->damage()) notices_.add(ui::Severity::kWarning, line);
  if (store()->is_read_only()) {
    state_.message = "The case is open read-only. New scans are not saved in it.";
  }
  list_cases();
}

void CaseController::warn_of_other_calibration() {
  if (store() == nullptr || source_.calibration() == nullptr) return;
  const auto kept = store()->calibration();
  if (!kept || !*kept || io::to_json(**kept) == io::to_json(*source_.calibration())) return;
  notices_.add(ui::Severity::kWarning,
               "This case was scanned with another calibration. New scans are measured with the "
               "sensor's present calibration. For the texture of the earlier scans, use: flytri "
               "reconstruct " +
                   store()->path());
}

void CaseController::set_fields(const ui::SetCaseFields& command) {
  if (store() == nullptr) return;
  io::CaseFields fields = command.fields;
  fields.created = store()->fields().value_or(io::CaseFields{}).created;
  if (auto written = store()->write_fields(fields); !written) {
    return notices_.add(ui::Severity::kError, written.error().message);
  }
  state_.fields = command.fields;
}

void CaseController::list_cases() {
  background_.run([this] {
    auto known = std::make_shared<std::vector<ui::KnownCase>>(known_cases(cases_folder()));
    return [this, known] { state_.known = std::move(*known); };
  });
}

void CaseController::report_failure() {
  const std::string failure = store()->failure();
  if (failure == reported_failure_) return;
  reported_failure_ = failure;
  if (failure.empty()) {
    notices_.add(ui::Severity::kInformation, "Everything is saved again: " + store()->path());
  } else {
    notices_.add(ui::Severity::kError, "Not saved: " + failure);
  }
}

ui::CaseState CaseController::state() {
  ui::CaseState state = state_;
  if (store() == nullptr) return state;
  report_failure();
  state.path = store()->path();
  state.is_read_only = store()->is_read_only();
  state.is_saved = reported_failure_.empty();
  return state;
}

}  // namespace flytri::session
