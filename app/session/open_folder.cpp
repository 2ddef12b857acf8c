#include "app/session/open_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "xdg-open";

/// Frees the settings of posix_spawn.
class SpawnSettings {
 public:
  SpawnSettings() {
    ::posix_spawn_file_actions_init(&files_);
    for (int descriptor = 0; descriptor <= 2; ++descriptor) {
      ::posix_spawn_file_actions_addopen(&files_, descriptor, "/dev/null", O_RDWR, 0);
    }
    ::posix_spawn_file_actions_addclosefrom_np(&files_, 3);
    ::posix_spawnattr_init(&attributes_);
    sigset_t signals;
    ::sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes_, &signals);
    ::sigfillset(&signals);
    ::posix_spawnattr_setsigdefault(&attributes_, &signals);
    ::posix_spawnattr_setflags(
        &attributes_,
        static_cast<short>(POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&files_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  [[nodiscard]] const posix_spawn_file_actions_t* files() const { return &files_; }
  [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

Result<void> FolderOpener::open(const fs::path& folder, const ui::Texts& texts) {
  std::error_code error;
  // An absolute path cannot be taken for an option.
  const fs::path absolute = fs::absolute(folder, error);
  if (error || !fs::is_directory(absolute, error)) {
    return fail(ErrorCode::kNotFound, "{}", texts.fill<ui::Text::kNoSuchFolder>(folder.string()));
  }
  const SpawnSettings settings;
  std::string program = kProgram, argument = absolute.string();
  const std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  pid_t process = -1;
  const int failure = ::posix_spawnp(&process, kProgram, settings.files(), settings.attributes(),
                                     arguments.data(), environ);
  if (failure != 0) {
    return fail(ErrorCode::kNotFound, "{}",
                texts.fill<ui::Text::kCannotShowFolder>(argument, kProgram,
                                                        std::generic_category().message(failure)));
  }
  started_.push_back({process, absolute});
  return {};
}

std::vector<std::string> FolderOpener::settle(const ui::Texts& texts) {
  std::vector<std::string> failures;
  std::erase_if(started_, [&](const Started& started) {
    int status = 0;
    const pid_t ended = ::waitpid(started.process, &status, WNOHANG);
    if (ended == 0) return false;
    if (ended > 0 && (!WIFEXITED(status) || WEXITSTATUS(status) != 0)) {
      failures.push_back(texts.fill<ui::Text::kNoFileManager>(started.folder.string()));
    }
    return true;
  });
  return failures;
}

}  // namespace flytri::session
