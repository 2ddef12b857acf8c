#include "core/io/files/leftovers.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <string>

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

constexpr std::time_t kDay_s = 86400;

/// Whether a name is this prefix and eight hexadecimal digits.
bool is_named(std::string_view name, std::string_view prefix) {
  constexpr std::size_t kDigits = 8;
  if (!name.starts_with(prefix)) return false;
  name.remove_prefix(prefix.size());
  return name.size() == kDigits && name.find_first_not_of("0123456789abcdef") == name.npos;
}

/// The time of the latest change of the name or the content: a second name has an old content.
bool is_old(const struct stat& status) { return status.st_ctime + kDay_s < std::time(nullptr); }

/// Whether the program that wrote a temporary file has ended. The lock, if it was free, is held
/// until the descriptor is closed, so that a program that just creates the file notices.
bool has_ended(int descriptor, const struct stat& status) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  return errno != EWOULDBLOCK && is_old(status);
}

void remove_leftover(const std::string& path, bool is_second_name) {
  // For writing, as a network file system demands it for locks.
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status {};
  const bool is_own =
      ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid();
  if (is_own && (is_second_name ? is_old(status) : has_ended(descriptor, status))) {
    ::unlink(path.c_str());
  }
  ::close(descriptor);
}

/// The temporary file that a database has this log of; empty: it is no log of one.
std::string owner_of_log(const std::string& name) {
  for (const std::string_view ending : {"-wal", "-shm", "-journal"}) {
    if (!name.ends_with(ending)) continue;
    std::string owner = name.substr(0, name.size() - ending.size());
    if (is_named(owner, kTemporaryPrefix)) return owner;
  }
  return {};
}

/// A log is there only as long as its file.
void remove_logs(const fs::path& folder) {
  std::error_code ended, ignored;
  fs::directory_iterator entry(folder, ended);
  for (; !ended && entry != fs::directory_iterator(); entry.increment(ended)) {
    const std::string owner = owner_of_log(entry->path().filename().string());
    if (!owner.empty() && !fs::exists(folder / owner, ignored)) fs::remove(entry->path(), ignored);
  }
}

}  // namespace

void remove_leftovers(const fs::path& folder) {
  std::error_code ended;
  const fs::path searched = folder.empty() ? fs::path(".") : folder;
  fs::directory_iterator entry(searched, ended);
  for (; !ended && entry != fs::directory_iterator(); entry.increment(ended)) {
    const std::string name = entry->path().filename().string();
    const bool is_second_name = is_named(name, kSecondNamePrefix);
    if (is_second_name || is_named(name, kTemporaryPrefix)) {
      remove_leftover(entry->path().string(), is_second_name);
    }
  }
  remove_logs(searched);
}

}  // namespace flytri::io
