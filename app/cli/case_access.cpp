#include "app/cli/case_access.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <utility>

#include "app/cli/console.h"
#include "app/session/case_events.h"
#include "core/io/files/secret_file.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

/// The value of the variable, which is wiped: other programs of this user could read it as long as
/// this one runs, and programs that this one starts would get it.
Secret take_from_environment(const char* variable) {
  char* const value = std::getenv(variable);
  if (value == nullptr) return {};
  Secret secret{value};
  wipe(value, std::strlen(value));
  ::unsetenv(variable);
  return secret;
}

Result<Secret> passphrase_of(const CaseArguments& arguments) {
  Secret from_environment = take_from_environment("FLYTRI_PASSPHRASE");
  if (arguments.passphrase_file.empty()) return from_environment;
  return io::read_secret(arguments.passphrase_file);
}

}  // namespace

Result<CaseAccess> CaseAccess::begin(const fs::path& path, const CaseArguments& arguments) {
  return passphrase_of(arguments).map(
      [&](Secret&& passphrase) { return CaseAccess(path, std::move(passphrase)); });
}

Result<io::CaseFile> CaseAccess::open(bool read_only) {
  Result<io::CaseFile> file = io::CaseFile::open(path_, {passphrase_, read_only});
  if (file) {
    print_damage(file->damage());
    note(read_only ? io::CaseAction::kOpenedReadOnly : io::CaseAction::kOpened, {}, {});
    return file;
  }
  if (file.error().code != ErrorCode::kInconsistent) return file;
  return fail(ErrorCode::kInconsistent,
              "{}; put the passphrase into the variable FLYTRI_PASSPHRASE, or into a file for "
              "--passphrase-file",
              file.error().message);
}

void CaseAccess::note(io::CaseAction action, std::optional<io::ScanStage> stage,
                      const std::vector<fs::path>& files) {
  notes_.push_back(session::event_now(action, stage, files));
}

Result<void> CaseAccess::try_to_write_notes() {
  Result<io::CaseFile> file = io::CaseFile::open(path_, {passphrase_, false});
  if (!file) return tl::unexpected(file.error());
  for (const io::CaseEvent& event : notes_) {
    if (auto added = file->add_event(event); !added) return added;
  }
  return file->commit();
}

void CaseAccess::write_notes() {
  if (notes_.empty()) return;
  const Result<void> written = try_to_write_notes();
  notes_.clear();
  if (written) return;
  print_error("flytri: warning: the journal of the case does not have this access: {}\n",
              written.error().message);
}

}  // namespace flytri::cli
