#include "app/session/case_controller.h"

#include <fmt/format.h>
#include <unistd.h>

#include <ctime>
#include <utility>
#include <vector>

#include "app/session/case_events.h"
#include "app/session/user_folders.h"
#include "core/base/iso_time.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/leftovers.h"

namespace flytri::session {
namespace {

std::filesystem::path cases_folder() { return data_folder() / "cases"; }

/// The fields, with the present time as that of the creation.
io::CaseFields created_now(io::CaseFields fields) {
  fields.created = iso_time(std::time(nullptr));
  return fields;
}

/// Beside the damaged case, under a name that is free.
std::filesystem::path rescue_path(const std::filesystem::path& damaged) {
  const std::string stem = (damaged.parent_path() / damaged.stem()).string() + "-rescued";
  std::filesystem::path path = stem + ".flytri";
  std::error_code ignored;
  for (int number = 2; std::filesystem::exists(path, ignored); ++number) {
    path = fmt::format("{}-{}.flytri", stem, number);
  }
  return path;
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

/// A case that may not be written can still be looked at.
Result<io::CaseFile> open_file(const ui::OpenCase& command) {
  io::CaseOptions options;
  options.passphrase = command.passphrase;
  auto file = io::CaseFile::open(command.path, options);
  if (file || file.error().code != ErrorCode::kNotPermitted) return file;
  options.read_only = true;
  auto to_read = io::CaseFile::open(command.path, options);
  return to_read ? std::move(to_read) : std::move(file);
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
  const ui::Texts& texts = notices_.texts();
  state_.message = texts.fill<ui::Text::kWaitForFinishing>(texts[ui::Text::kKeyEscape]);
  return true;
}

void CaseController::create(const ui::NewCase& command) {
  if (refuses_while_finishing()) return;
  if (source_.calibration() == nullptr) {
    state_.message = notices_.texts()[ui::Text::kWaitForSensor];
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
    auto file = std::make_shared<Result<io::CaseFile>>(open_file(command));
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
  if (store()->is_read_only() && !store()->is_damaged()) {
    state_.message = notices_.texts()[ui::Text::kOpenReadOnly];
  }
  list_cases();
}

void CaseController::warn_of_other_calibration() {
  if (store() == nullptr || source_.calibration() == nullptr) return;
  const auto kept = store()->calibration();
  if (!kept || !*kept || io::fingerprint(**kept) == io::fingerprint(*source_.calibration())) return;
  notices_.add(ui::Severity::kWarning,
               notices_.texts().fill<ui::Text::kOtherCalibration>(store()->path()));
}

void CaseController::look_at_damage() {
  if (store() == nullptr || !store()->is_damaged()) {
    state_.damaged.reset();
    looked_at_.reset();
    return;
  }
  if (looked_at_ == stages_.store()) return;
  looked_at_ = stages_.store();
  state_.damaged.emplace();
  state_.damaged->copy_path = rescue_path(looked_at_->path()).string();
  background_.run([this, store = looked_at_] {
    auto survey = std::make_shared<Result<io::CaseSurvey>>(store->survey());
    return [this, store, survey] {
      if (store != looked_at_ || !state_.damaged) return;
      if (!*survey) {
        state_.damaged->survey.emplace();
        state_.damaged->survey->lost.push_back(survey->error().message);
        return;
      }
      state_.damaged->survey = std::move(**survey);
    };
  });
}

void CaseController::save_rescue_copy(const ui::SaveRescueCopy& command) {
  if (!state_.damaged || state_.damaged->is_copying || refuses_while_finishing()) return;
  state_.damaged->is_copying = true;
  state_.message.clear();
  // What waits in memory because the case is damaged goes into the copy, too.
  background_.run(
      [this, path = command.path, store = stages_.store(), rest = stages_.come_to_rest()] {
        rest();
        auto copied = std::make_shared<Result<io::CaseSurvey>>(store->rescue_to(path));
        auto copy = std::make_shared<Result<io::CaseFile>>(
            *copied ? io::CaseFile::open(path, {.passphrase = store->passphrase()})
                    : tl::unexpected(copied->error()));
        return [this, store, path, copy] {
          if (store != stages_.store()) return;
          if (!*copy) {
            if (state_.damaged) state_.damaged->is_copying = false;
            state_.message = copy->error().message;
            return stages_.show();
          }
          const bool is_encrypted = !store->passphrase().empty();
          stages_.replace_by(std::make_shared<CaseStore>(std::move(**copy)));
          accept_opened(is_encrypted);
          notices_.add(ui::Severity::kInformation,
                       notices_.texts().fill<ui::Text::kRescueOpened>(path));
        };
      });
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
  const ui::Texts& texts = notices_.texts();
  if (failure.empty()) {
    notices_.add(ui::Severity::kInformation, texts.fill<ui::Text::kSavedAgain>(store()->path()));
  } else {
    notices_.add(ui::Severity::kError, texts.fill<ui::Text::kNotSavedBecause>(failure));
  }
}

ui::CaseState CaseController::state() {
  look_at_damage();
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
