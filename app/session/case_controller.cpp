#include "app/session/case_controller.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <ctime>
#include <utility>
#include <vector>

#include "app/session/case_events.h"
#include "app/session/user_folders.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/leftovers.h"

namespace flytri::session {
namespace {

std::filesystem::path cases_folder() { return data_folder() / "cases"; }

/// The fields, with the present time as that of the creation.
io::CaseFields created_now(io::CaseFields fields) {
  fields.created = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return fields;
}

/// Creates the file with all that a case needs from the beginning.
Result<io::CaseFile> create_file(const ui::NewCase& command,
                                 const calibration::Calibration& calibration) {
  const std::filesystem::path path = command.path;
  if (auto made = io::create_private_folder(path.parent_path()); !made)
    return tl::unexpected(made.error());
  const io::CaseFields fields = created_now(command.fields);
  io::CaseOptions options;
  options.passphrase = command.passphrase;
  auto file = io::CaseFile::create(path, options, fields, io::to_json(calibration));
  if (!file) return file;
  auto noted =
      file->add_event(event_now(io::CaseAction::kCreated)).and_then([&] { return file->commit(); });
  if (noted) return file;
  file = tl::unexpected(noted.error());
  io::remove_case(path);
  return file;
}

}  // namespace

CaseController::CaseController(std::filesystem::path unnamed_folder, const SourceController& source,
                               StageController& stages, BackgroundWork& background,
                               Notices& notices)
    : unnamed_folder_(std::move(unnamed_folder)),
      source_(source),
      stages_(stages),
      background_(background),
      notices_(notices) {
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
  if (is_unnamed()) return name_unnamed(command);
  Result<io::CaseFile> file = create_file(command, *source_.calibration());
  if (!file) {
    state_.message = file.error().message;
    return;
  }
  auto opened = std::make_shared<CaseStore>(std::move(*file));
  if (store() == nullptr) {
    stages_.save_in(opened);
  } else {
    replace_by(std::move(opened));
  }
  accept_opened(!command.passphrase.empty());
}

bool CaseController::is_unnamed() const {
  return store() != nullptr &&
         std::filesystem::path(store()->path()).parent_path() == unnamed_folder_;
}

void CaseController::save_unnamed() {
  if (store() != nullptr || source_.calibration() == nullptr) return;
  ui::NewCase command;
  command.path = (unnamed_folder_ / fmt::format("{:%Y-%m-%d-%H%M%S}-{}.flytri",
                                                fmt::localtime(std::time(nullptr)), ::getpid()))
                     .string();
  Result<io::CaseFile> file = create_file(command, *source_.calibration());
  state_.failure = file ? "" : file.error().message;
  if (!file) return;
  stages_.save_in(std::make_shared<CaseStore>(std::move(*file)));
}

void CaseController::name_unnamed(const ui::NewCase& command) {
  const std::filesystem::path folder = std::filesystem::path(command.path).parent_path();
  if (auto made = io::create_private_folder(folder); !made) {
    state_.message = made.error().message;
    return;
  }
  state_.is_moving = true;
  background_.run([this, command, store = stages_.store()] {
    const auto moved = std::make_shared<Result<void>>(
        store->move_to(command.path, command.passphrase, created_now(command.fields)));
    return [this, command, moved] {
      state_.is_moving = false;
      if (*moved) return accept_opened(!command.passphrase.empty());
      state_.message = moved->error().message;
    };
  });
}

void CaseController::replace_by(std::shared_ptr<CaseStore> opened) {
  close();
  stages_.replace_by(std::move(opened));
}

void CaseController::close() {
  if (!is_unnamed() || stages_.has_model() || store()->has_views()) return;
  io::remove_case(store()->path());
}

void CaseController::discard(const ui::DiscardCase& command) {
  const std::filesystem::path path = command.path;
  if (path.parent_path() != unnamed_folder_ || path.extension() != ".flytri") return;
  if (store() != nullptr && store()->path() == command.path) {
    if (refuses_while_finishing()) return;
    stages_.replace_by(nullptr);
  }
  io::remove_case(path);
  list_cases();
}

void CaseController::open(const ui::OpenCase& command) {
  if (refuses_while_finishing()) return;
  state_.is_opening = true;
  state_.message.clear();
  background_.run([this, command] {
    io::CaseOptions options;
    options.passphrase = command.passphrase;
    auto file = std::make_shared<Result<io::CaseFile>>(io::CaseFile::open(command.path, options));
    return [this, command, file] {
      state_.is_opening = false;
      if (!*file) {
        state_.message = file->error().message;
        state_.passphrase_is_asked = file->error().code == ErrorCode::kInconsistent;
        state_.path_asked = command.path;
        return;
      }
      if (refuses_while_finishing()) return;
      replace_by(std::make_shared<CaseStore>(std::move(**file)));
      store()->note(event_now(io::CaseAction::kOpened));
      accept_opened(!command.passphrase.empty());
      warn_of_other_calibration();
    };
  });
}

void CaseController::accept_opened(bool is_encrypted) {
  state_.message.clear();
  state_.passphrase_is_asked = false;
  state_.is_encrypted = is_encrypted;
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
    for (const auto& folder : {unnamed_folder_, cases_folder()}) io::remove_leftovers(folder);
    auto known = std::make_shared<std::vector<ui::KnownCase>>(unnamed_cases(unnamed_folder_));
    for (ui::KnownCase& named : known_cases(cases_folder())) known->push_back(std::move(named));
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
  state.is_unnamed = is_unnamed();
  state.is_read_only = store()->is_read_only();
  state.is_saved = reported_failure_.empty();
  state.failure = reported_failure_;
  return state;
}

}  // namespace flytri::session
