#include "core/io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iterator>
#include <random>
#include <system_error>
#include <utility>

#include "core/io/files/file_errors.h"
#include "core/io/files/leftovers.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

/// A name in the folder of `path` that is most likely free. Hidden and short: a long name of the
/// file itself does not exceed the limit.
std::string temporary_beside(const fs::path& path, std::string_view prefix) {
  std::random_device random;
  return (path.parent_path() / fmt::format("{}{:08x}", prefix, random())).string();
}

/// Locks a new file: remove_leftovers() keeps locked files. False if it has removed the file
/// already. Where a file system has no locks, remove_leftovers() goes by age.
bool lock_new(int descriptor) {
  while (::flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
  }
  struct stat status {};
  return ::fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

/// Gives the new file the permissions of the file that it replaces, if there is one.
void copy_permissions(int descriptor, const fs::path& path) {
  struct stat former {};
  // A failure is harmless: the file is complete and belongs to its owner.
  if (::stat(path.c_str(), &former) == 0) (void)::fchmod(descriptor, former.st_mode & 07777U);
}

/// A new name is on the disk when its folder is. Folders that cannot be opened, and file systems
/// that cannot flush a folder, are passed over: the file is there all the same.
Result<void> sync_folder_of(const fs::path& path) {
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return {};
  const int error = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  ::close(descriptor);
  if (error != 0) return write_failure(path, error);
  return {};
}

/// Renames unless the new name is taken. @return  an errno
int rename_to_new(const char* from, const char* to) {
  if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // A network file system cannot tell in one step.
  struct stat status {};
  if (::lstat(to, &status) == 0) return EEXIST;
  return ::rename(from, to) == 0 ? 0 : errno;
}

/// A file that is about to be replaced, kept under a second name until that is certain.
class FormerFile {
 public:
  /// @errors  kWriteFailed, kNotPermitted: there is a former file, but it cannot be kept.
  [[nodiscard]] static Result<FormerFile> keep(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
      return write_failure(path, EISDIR);
    }
    std::string second_name;
    int error = EEXIST;
    while (error == EEXIST) {
      second_name = temporary_beside(path, kSecondNamePrefix);
      error = ::link(path.c_str(), second_name.c_str()) == 0 ? 0 : errno;
    }
    if (error == ENOENT) return FormerFile(path, {});
    // Memory sticks often have a file system without second names. There the file has only this
    // name for a moment, so it is one that remove_leftovers() never removes.
    if (error != 0) {
      second_name = temporary_beside(path, kMovedPrefix);
      error = ::rename(path.c_str(), second_name.c_str()) == 0 ? 0 : errno;
    }
    if (error != 0) return write_failure(path, error);
    return FormerFile(path, std::move(second_name));
  }
  FormerFile(FormerFile&& other) noexcept
      : path_(std::move(other.path_)), second_name_(std::exchange(other.second_name_, {})) {}
  FormerFile& operator=(FormerFile&&) = delete;
  FormerFile(const FormerFile&) = delete;
  FormerFile& operator=(const FormerFile&) = delete;
  ~FormerFile() {
    if (!second_name_.empty()) ::unlink(second_name_.c_str());
  }

  /// Undoes what happened to the path since keep().
  void put_back() {
    if (second_name_.empty()) {
      ::unlink(path_.c_str());
    } else {
      // If nothing happened to the path, this does nothing: both names are of the same file.
      ::rename(second_name_.c_str(), path_.c_str());
    }
  }

 private:
  FormerFile(fs::path path, std::string second_name)
      : path_(std::move(path)), second_name_(std::move(second_name)) {}

  fs::path path_;
  std::string second_name_;  ///< empty: there was no file
};

Result<void> rename_all(std::vector<AtomicFile>& files, std::vector<FormerFile>& former) {
  for (AtomicFile& file : files) {
    Result<FormerFile> kept = FormerFile::keep(file.path());
    if (!kept) return tl::unexpected(kept.error());
    former.push_back(*std::move(kept));
    if (Result<void> renamed = file.commit_unsynced(); !renamed) return renamed;
  }
  for (const AtomicFile& file : files) {
    if (Result<void> synced = sync_folder_of(file.path()); !synced) return synced;
  }
  return {};
}

}  // namespace

AtomicFile::AtomicFile(fs::path path, std::string temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  path_ = std::move(other.path_);
  temporary_ = std::move(other.temporary_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
  descriptor_ = -1;
}

Result<AtomicFile> AtomicFile::create(const fs::path& path, Access access) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    return fail(ErrorCode::kWriteFailed, "{}: is a folder; give the path of a file", path.string());
  }
  std::string temporary;
  int descriptor = -1;
  const mode_t mode = access == Access::kOwnerOnly ? 0600 : 0666;
  while (descriptor < 0) {
    temporary = temporary_beside(path, kTemporaryPrefix);
    // Not mkstemp(): only the owner could read the file, and umask() is not safe to read while
    // other threads run.
    descriptor = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor < 0 && errno != EEXIST) return write_failure(path, errno);
    if (descriptor >= 0 && !lock_new(descriptor)) ::close(std::exchange(descriptor, -1));
  }
  if (access == Access::kByUmask) copy_permissions(descriptor, path);
  return AtomicFile(path, std::move(temporary), descriptor);
}

Result<void> AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return write_failure(path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> AtomicFile::sync() {
  // Some file systems notice only here that the disk is full.
  if (::fsync(descriptor_) != 0) return write_failure(path_, errno);
  return {};
}

Result<void> AtomicFile::commit() {
  if (Result<void> synced = sync(); !synced) return synced;
  if (Result<void> renamed = commit_unsynced(); !renamed) return renamed;
  return sync_folder_of(path_);
}

Result<void> AtomicFile::commit_unsynced() {
  return close_and_rename(
      [](const char* from, const char* to) { return ::rename(from, to) == 0 ? 0 : errno; });
}

Result<void> AtomicFile::commit_new() {
  if (Result<void> synced = sync(); !synced) return synced;
  if (Result<void> renamed = close_and_rename(rename_to_new); !renamed) return renamed;
  Result<void> synced = sync_folder_of(path_);
  if (!synced) ::unlink(path_.c_str());
  return synced;
}

Result<void> AtomicFile::close_and_rename(int (*rename)(const char* from, const char* to)) {
  // Closing may fail, so it comes before renaming. The second descriptor keeps the lock meanwhile.
  const int lock = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  const int descriptor = std::exchange(descriptor_, -1);
  int error = ::close(descriptor) == 0 ? 0 : errno;
  if (error == 0) error = rename(temporary_.c_str(), path_.c_str());
  if (lock >= 0) ::close(lock);
  if (error == 0) return {};
  ::unlink(temporary_.c_str());
  if (error == EEXIST) return file_exists(path_);
  return write_failure(path_, error);
}

Result<void> commit_together(std::vector<AtomicFile> files) {
  for (AtomicFile& file : files) {
    if (Result<void> synced = file.sync(); !synced) return synced;
  }
  std::vector<FormerFile> former;
  Result<void> outcome = rename_all(files, former);
  if (!outcome) {
    for (auto file = former.rbegin(); file != former.rend(); ++file) file->put_back();
  }
  return outcome;
}

}  // namespace flytri::io
